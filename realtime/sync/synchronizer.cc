#include "realtime/sync/synchronizer.h"

#include <utility>

namespace sparsight {
namespace {

// 2090, for recordings on a time line that begins with 1970. A recording may claim any time; within
// this, differences of two fit.
constexpr HostTime kEndOfTime{std::chrono::hours(24 * 365 * 120)};

}  // namespace

SyncConfig sync_config(const RigConfig& rig) {
  SyncConfig config;
  config.edges.exposure_active = rig.trigger.exposure_active;
  config.edges.trigger_delay = rig.trigger.trigger_delay;
  return config;
}

Synchronizer::Synchronizer(const RigCalibration& calibration, const SyncConfig& config,
                           std::unique_ptr<LidarDecoder> decoder, JpegDecoder jpeg)
    : config_(config),
      decoder_(std::move(decoder)),
      matcher_(config.edges),
      clock_(config.clock),
      buffer_(config.buffer),
      bundler_(calibration.camera, config.bundler, std::move(jpeg)) {}

void Synchronizer::add(const RigEvent& event) {
  if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event);
      frame && !*frame) {
    return;
  }
  const HostTime arrival = arrival_of(event);
  if (arrival < HostTime{} || arrival > kEndOfTime) {
    ++counts_.events_refused;
    return;
  }
  std::visit([this](const auto& e) { handle(e); }, event);
}

void Synchronizer::handle(const std::shared_ptr<const CameraFrame>& frame) {
  if (config_.exposure_source == ExposureSource::kDriverTime) {
    stamp_by_driver(frame);
  } else {
    matcher_.add(frame, decided_);
  }
  bundle_decided();
}

void Synchronizer::handle(const Edge& edge) {
  if (edge.line == EdgeLine::kPps) {
    clock_.add(edge);
  } else {
    matcher_.add(edge);
  }
}

void Synchronizer::handle(const LidarPacket& packet) {
  if (!decoder_->decode(packet, packet_)) return;
  clock_.add(packet_);
  buffer_.add(packet_);
}

void Synchronizer::handle(const PositionPacket& packet) {
  if (const auto report = decoder_->decode(packet)) clock_.add(*report);
}

// A camera that is gone delivers nothing that could decide on the frames held back.
void Synchronizer::handle(const DeviceStateChange& change) {
  if (change.device != DeviceKind::kCamera || change.state == DeviceState::kStreaming) return;
  matcher_.finish(decided_);
  bundle_decided();
}

void Synchronizer::finish() {
  matcher_.finish(decided_);
  bundle_decided();
}

void Synchronizer::stamp_by_driver(const std::shared_ptr<const CameraFrame>& frame) {
  ++counts_.camera.frames;
  if (frame->driver_time < HostTime{} || frame->driver_time > kEndOfTime ||
      (last_exposure_ && frame->driver_time <= *last_exposure_)) {
    ++counts_.camera.frames_unsynchronized;
    return;
  }
  last_exposure_ = frame->driver_time;
  ++counts_.camera.frames_estimated;
  decided_.push_back({.frame = frame,
                      .stamp = {.arrival = frame->arrival,
                                .mapped = frame->driver_time,
                                .uncertainty = config_.driver_time_sigma,
                                .epoch = frame->epoch,
                                .quality = StampQuality::kEstimated}});
}

void Synchronizer::bundle_decided() {
  for (const StampedFrame& stamped : decided_) {
    if (!stamped.synchronized()) continue;
    if (ready_.size() >= config_.ready_frames) {
      ready_.pop_front();
      ++counts_.frames_not_taken;
    }
    ready_.push_back(bundler_.bundle(stamped, buffer_, clock_));
    ++counts_.frames_out;
    if (ready_.back().frame.grey.empty()) ++counts_.frames_without_image;
    if (ready_.back().frame.sweep.returns.empty()) ++counts_.frames_without_returns;
  }
  decided_.clear();
}

std::optional<BundledFrame> Synchronizer::take() {
  std::optional<BundledFrame> frame;
  if (ready_.empty()) return frame;
  frame.emplace(std::move(ready_.front()));
  ready_.pop_front();
  return frame;
}

SyncState Synchronizer::state() const {
  SyncState state = counts_;
  if (config_.exposure_source == ExposureSource::kEdges) state.camera = matcher_.state();
  state.lidar = clock_.state();
  state.packets = decoder_->counters();
  return state;
}

}  // namespace sparsight
