#include "realtime/sync/frame_bundler.h"

#include <string>
#include <utility>

namespace sparsight {

FrameBundler::FrameBundler(const CameraIntrinsics& camera, const FrameBundlerConfig& config,
                           JpegDecoder jpeg)
    : camera_(camera), config_(config), jpeg_(std::move(jpeg)) {}

BundledFrame FrameBundler::bundle(const StampedFrame& stamped, const LidarBuffer& returns,
                                  const LidarClock& clock) {
  BundledFrame out{.stamp = stamped.stamp,
                   .camera_epoch = stamped.frame->epoch,
                   .camera_sequence = stamped.frame->sequence};
  out.frame.sequence = next_sequence_++;
  out.frame.exposure = stamped.stamp.mapped;
  add_image(*stamped.frame, out.frame);
  add_returns(stamped, returns, clock, out);
  return out;
}

void FrameBundler::add_image(const CameraFrame& frame, SynchronizedFrame& out) const {
  if (frame.damaged) {
    out.faults.push_back({ErrorCode::kMalformed, "camera frame " + std::to_string(frame.sequence) +
                                                     " was damaged on its way; see the cable"});
    return;
  }
  if (frame.width != camera_.width || frame.height != camera_.height) {
    out.faults.push_back({ErrorCode::kWrongSize, "camera frame of " + std::to_string(frame.width) +
                                                     " x " + std::to_string(frame.height) +
                                                     ", but the calibration is for " +
                                                     std::to_string(camera_.width) + " x " +
                                                     std::to_string(camera_.height)});
    return;
  }
  Result<ConvertedImage> image = convert_image(frame, config_.with_color, jpeg_);
  if (!image) {
    out.faults.push_back(std::move(image.error()));
  } else if (image->grey.width != camera_.width || image->grey.height != camera_.height) {
    out.faults.push_back({ErrorCode::kWrongSize,
                          "the image within the camera frame has another size "
                          "than the frame says"});
  } else {
    out.grey = std::move(image->grey);
    out.color = std::move(image->color);
  }
}

void FrameBundler::add_returns(const StampedFrame& stamped, const LidarBuffer& returns,
                               const LidarClock& clock, BundledFrame& out) const {
  const auto& mapping = clock.mapping();
  if (!mapping || mapping->uncertainty > config_.most_lidar_uncertainty) {
    out.frame.faults.push_back(
        {ErrorCode::kNotFound, mapping ? "the LiDAR's clock is not known well enough yet"
                                       : "nothing has come from the LiDAR yet"});
    return;
  }
  out.lidar_uncertainty = mapping->uncertainty;
  switch (
      returns.sweep(stamped.frame->arrival, mapping->line, stamped.stamp.mapped, out.frame.sweep)) {
    case SweepOutcome::kWhole:
    case SweepOutcome::kPartial:
      if (!out.frame.sweep.returns.empty()) return;
      out.frame.faults.push_back({ErrorCode::kNotFound, "the LiDAR sees nothing within its range"});
      return;
    case SweepOutcome::kNoPackets:
    case SweepOutcome::kTooOld:
      out.frame.faults.push_back(
          {ErrorCode::kNotFound, "nothing came from the LiDAR around this exposure"});
      return;
  }
}

}  // namespace sparsight
