#include "tools/playback/playback_session.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"
#include "tools/configuration/rig_file.h"
#include "tools/playback/playback_faults.h"
#include "tools/session/atomic_file.h"
#include "tools/session/interrupt.h"

namespace sparsight {
namespace {

using Json = nlohmann::ordered_json;

Result<RigConfig> rig_of(RecordingSource& recording, const PlaybackOptions& options) {
  const auto description = recording.attachment(kRigConfigurationAttachment);
  if (!description) return tl::unexpected(description.error());
  return parse_rig(*description, options.recording.string() + "#rig.toml").map([&](RigConfig rig) {
    return rig_on_devices(std::move(rig), options.devices);
  });
}

// The camera is opened for frames as they are in the recording.
Result<std::shared_ptr<const CameraFrame>> first_frame(const std::filesystem::path& file) {
  auto recording = RecordingSource::open(file);
  if (!recording) return tl::unexpected(recording.error());
  while (const auto event = (*recording)->next()) {
    if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&*event)) return *frame;
  }
  return fail(ErrorCode::kMissingField, file.string() + ": holds no frame of a camera");
}

PlaybackReport report_of(const DevicePlayer& player) {
  return {.moved_by = player.moved_by(),
          .camera = player.counts(DeviceKind::kCamera),
          .lidar = player.counts(DeviceKind::kLidar),
          .trigger = player.counts(DeviceKind::kTrigger),
          .remarks = player.remarks()};
}

double microseconds(std::chrono::nanoseconds duration) {
  return 1e-3 * static_cast<double>(duration.count());
}

std::string line_of(const char* what, const PlayedCounts& counts) {
  std::string line = fmt::format("{:8} {} played, {} withheld; at most {:.0f} us late\n", what,
                                 counts.played, counts.withheld, microseconds(counts.late.max));
  if (counts.refused > 0) {
    line += fmt::format("{:8} {} refused: {}\n", what, counts.refused,
                        std::generic_category().message(counts.last_errno));
  }
  return line;
}

Json json_of(const PlayedCounts& counts) {
  Json json{{"played", counts.played},
            {"withheld", counts.withheld},
            {"refused", counts.refused},
            {"late_us",
             {{"p50", microseconds(counts.late.percentile(0.5))},
              {"p99", microseconds(counts.late.percentile(0.99))},
              {"max", microseconds(counts.late.max)}}}};
  if (counts.refused > 0) json["why"] = std::generic_category().message(counts.last_errno);
  return json;
}

}  // namespace

Result<PlaybackReport> play_into_devices(const PlaybackOptions& options) {
  auto recording = RecordingSource::open(options.recording);
  if (!recording) return tl::unexpected(recording.error());
  const auto rig = rig_of(**recording, options);
  if (!rig) return tl::unexpected(rig.error());
  const auto like = first_frame(options.recording);
  if (!like) return tl::unexpected(like.error());
  auto devices = open_rig_devices(*rig, options.devices, **like);
  if (!devices) return tl::unexpected(devices.error());
  if (!options.write_rig.empty()) {
    if (auto written = write_file(options.write_rig, describe(*rig)); !written) {
      return tl::unexpected(written.error());
    }
  }
  const InterruptRequest interrupt;
  const HostTime first = (*recording)->info().first;
  PlaybackFaults faults(options.faults, first, options.seed);
  DevicePlayer player(std::move(*devices));
  player.play(**recording, {.withhold = [&](const RigEvent& e) { return faults.withhold(e); },
                            .first = first,
                            .lead = options.lead,
                            .stop = [&] { return interrupt.pending(); }});
  PlaybackReport report = report_of(player);
  report.whole = !interrupt.pending();
  return report;
}

std::string playback_text(const PlaybackReport& report) {
  std::string text = line_of("frames", report.camera) + line_of("packets", report.lidar) +
                     line_of("edges", report.trigger);
  for (const std::string& remark : report.remarks) text += "note     " + remark + "\n";
  if (!report.whole) text += "note     interrupted\n";
  return text;
}

std::string playback_json(const PlaybackReport& report) {
  const Json json{{"moved_by_ns", report.moved_by.count()}, {"whole", report.whole},
                  {"camera", json_of(report.camera)},       {"lidar", json_of(report.lidar)},
                  {"trigger", json_of(report.trigger)},     {"remarks", report.remarks}};
  return json.dump(2) + "\n";
}

}  // namespace sparsight
