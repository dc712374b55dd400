#include "tools/doctor/recording_examination.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "tools/configuration/rig_file.h"
#include "tools/doctor/camera_checks.h"
#include "tools/doctor/frame_examination.h"
#include "tools/doctor/host_checks.h"
#include "tools/doctor/lidar_checks.h"
#include "tools/doctor/trigger_checks.h"

namespace sparsight {
namespace {

struct RecordedObservations {
  CameraObservation camera;
  LidarObservation lidar;
  TriggerObservation trigger;
};

// Counts what passes by, as the live devices would have been watched.
class WatchedEvents final : public RigEventSource {
 public:
  WatchedEvents(RecordingSource& events, const RigConfig& rig, RecordedObservations& seen)
      : events_(events),
        exposure_active_(rig.trigger.exposure_active),
        decoder_(rig.lidar),
        seen_(seen) {}

  std::optional<RigEvent> next() override {
    auto event = events_.next();
    if (!event) return event;
    const HostTime arrival = arrival_of(*event);
    if (!first_) first_ = arrival;
    last_ = arrival;
    std::visit([this](const auto& e) { watch(e); }, *event);
    return event;
  }

  void finish() {
    const auto rate = [](const Span& span) {
      const double seconds = to_seconds(span.last - span.first);
      return span.count > 1 && seconds > 0.0 ? static_cast<double>(span.count - 1) / seconds : 0.0;
    };
    seen_.camera.rate_hz = rate(frames_);
    seen_.lidar.packets_per_s = rate(packets_);
    seen_.lidar.decoded = decoder_.counters();
    seen_.trigger.seconds = first_ ? to_seconds(last_ - *first_) : 0.0;
  }

 private:
  struct Span {
    std::uint64_t count = 0;
    HostTime first;
    HostTime last;
    void add(HostTime time) {
      if (count++ == 0) first = time;
      last = time;
    }
  };

  void watch(const std::shared_ptr<const CameraFrame>& frame) {
    CameraObservation& camera = seen_.camera;
    const bool follows = camera.counters.frames++ > 0;
    if (follows && frame->epoch != camera.last.epoch) {
      ++camera.counters.restarts;
    } else if (follows && frame->sequence > camera.last.sequence) {
      camera.counters.lost += frame->sequence - camera.last.sequence - 1;
    }
    if (frame->damaged) ++camera.counters.damaged;
    frames_.add(frame->arrival);
    camera.last = *frame;
    camera.last.bytes.clear();
  }
  void watch(const LidarPacket& packet) {
    ++seen_.lidar.counters.packets;
    packets_.add(packet.arrival);
    decoder_.decode(packet, decoded_);
  }
  void watch(const PositionPacket& packet) {
    ++seen_.lidar.counters.positions;
    if (const auto report = decoder_.decode(packet)) seen_.lidar.clock = report;
  }
  void watch(const Edge& edge) {
    auto& before = before_[edge.line == EdgeLine::kPps ? 1 : 0];
    const bool both = edge.line == EdgeLine::kExposure && exposure_active_;
    if (both && before == edge.rising) ++seen_.trigger.counters.repeated;
    before = edge.rising;
    ++seen_.trigger.counters.edges;
    if (!edge.rising) return;
    ++(edge.line == EdgeLine::kPps ? seen_.trigger.pulses : seen_.trigger.exposures);
  }
  void watch(const DeviceStateChange& /*change*/) {}

  RecordingSource& events_;
  const bool exposure_active_;
  Vlp16Decoder decoder_;
  DecodedPacket decoded_;
  RecordedObservations& seen_;
  std::optional<HostTime> first_;
  HostTime last_;
  Span frames_;
  Span packets_;
  std::array<std::optional<bool>, 2> before_;
};

// Hands on what is watched elsewhere.
class BorrowedEvents final : public RigEventSource {
 public:
  explicit BorrowedEvents(RigEventSource& events) : events_(events) {}
  std::optional<RigEvent> next() override { return events_.next(); }

 private:
  RigEventSource& events_;
};

Check file_check(const RecordingSource& recording) {
  const RecordingInfo& info = recording.info();
  Check check{"recording", Verdict::kOk,
              fmt::format("{}: {:.1f} s, {:.1f} MB", info.file, to_seconds(info.duration()),
                          static_cast<double>(info.bytes) / 1e6),
              ""};
  if (info.truncated || !info.indexed) {
    check.verdict = Verdict::kWarn;
    check.found += ", cut off";
    check.fix = "sparsight recover gives it its index back; the last second may be missing";
  }
  if (const auto refused = recording.faults().refused_messages; refused > 0) {
    check.verdict = Verdict::kFail;
    check.found += fmt::format(", {} damaged messages", refused);
    check.fix = "the file is damaged: check the disk it was recorded to";
  }
  return check;
}

Result<RigConfig> rig_of(RecordingSource& recording, const std::optional<RigConfig>& given) {
  if (given) return *given;
  const auto description = recording.attachment(kRigConfigurationAttachment);
  if (!description) {
    return fail(description.error().code,
                description.error().message + "; give the rig's file with --rig");
  }
  return parse_rig(*description, recording.info().file + "#rig.toml");
}

}  // namespace

Result<std::vector<Check>> examine_recording(const std::filesystem::path& file,
                                             const std::optional<RigConfig>& given,
                                             const std::filesystem::path& overlay) {
  auto recording = RecordingSource::open(file);
  if (!recording) return tl::unexpected(recording.error());
  const auto rig = rig_of(**recording, given);
  if (!rig) return tl::unexpected(rig.error());
  RecordedObservations seen;
  WatchedEvents watched(**recording, *rig, seen);
  const auto of_frames = examine_events(std::make_unique<BorrowedEvents>(watched), *rig, overlay);
  watched.finish();
  std::vector<Check> checks{file_check(**recording)};
  for (auto&& part : {camera_checks(seen.camera, rig->camera), lidar_checks(seen.lidar, *rig),
                      trigger_checks(seen.trigger, *rig),
                      std::vector<Check>{calibration_check(rig->calibration)}, of_frames}) {
    checks.insert(checks.end(), part.begin(), part.end());
  }
  return checks;
}

}  // namespace sparsight
