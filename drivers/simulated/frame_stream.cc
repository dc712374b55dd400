#include "drivers/simulated/frame_stream.h"

#include <cstddef>

namespace sparsight::simulated {
namespace {

constexpr int kBlurLooks = 5;

}  // namespace

FrameStream::FrameStream(const FrameContext& context)
    : context_(context),
      renderer_(context.world, context.calibration.camera, context.options.color),
      imager_(context.options, context.calibration.camera, context.world.scene().exposure_gain),
      images_([this](std::uint64_t i) { return look(due_[i].number); }, 3) {
  plan();
}

void FrameStream::plan() {
  std::uint32_t sequence = 0;
  std::uint32_t epoch = 0;
  for (std::uint64_t number = 0;; ++number) {
    const Elapsed exposed = context_.clock.frame(number).exposed;
    if (exposed + context_.options.exposure > context_.options.duration) break;
    if (context_.faults.away(DeviceKind::kCamera, exposed)) continue;
    if (context_.faults.times_away(DeviceKind::kCamera, exposed) != epoch) {
      ++epoch;
      sequence = 0;
    }
    if (!context_.faults.loses_frame(number)) due_.push_back({number, sequence, epoch});
    ++sequence;
  }
}

std::vector<std::uint8_t> FrameStream::look(std::uint64_t number) const {
  const FrameTimes times = context_.clock.frame(number);
  if (context_.faults.covered(times.middle)) {
    const auto& camera = context_.calibration.camera;
    return imager_.expose(std::vector<float>(static_cast<std::size_t>(camera.width) *
                                             static_cast<std::size_t>(camera.height)),
                          number);
  }
  const Eigen::Isometry3d T_lidar_camera = context_.calibration.T_camera_lidar.inverse();
  const auto light_at = [&](Elapsed at) {
    return renderer_.render(context_.walk.lidar_pose(to_seconds(at)) * T_lidar_camera);
  };
  if (!context_.options.motion_blur) return imager_.expose(light_at(times.middle), number);
  std::vector<float> sum;
  for (int i = 0; i < kBlurLooks; ++i) {
    const Elapsed at =
        times.exposed + Elapsed(context_.options.exposure) * (2 * i + 1) / (2 * kBlurLooks);
    const std::vector<float> light = light_at(at);
    sum.resize(light.size());
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += light[k] / kBlurLooks;
  }
  return imager_.expose(sum, number);
}

std::optional<HostTime> FrameStream::peek() const {
  if (next_ >= due_.size()) return std::nullopt;
  return context_.options.start + context_.clock.frame(due_[next_].number).arrival;
}

RigEvent FrameStream::take() {
  const Due& due = due_[next_];
  const FrameTimes times = context_.clock.frame(due.number);
  auto frame = std::make_shared<CameraFrame>();
  frame->sequence = due.sequence;
  frame->epoch = due.epoch;
  frame->driver_time = context_.options.start + times.driver;
  frame->arrival = context_.options.start + times.arrival;
  frame->exposure = context_.options.exposure;
  frame->format = context_.options.color ? PixelFormat::kBayerRggb8 : PixelFormat::kGrey8;
  frame->width = frame->stride_bytes = context_.options.width;
  frame->height = context_.options.height;
  frame->bytes = images_.take(next_, due_.size());
  ++next_;
  return std::shared_ptr<const CameraFrame>(std::move(frame));
}

}  // namespace sparsight::simulated
