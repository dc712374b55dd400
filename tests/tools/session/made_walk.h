#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "drivers/recording/recording_writer.h"
#include "drivers/simulated/simulated_rig.h"
#include "tests/drivers/datasets/made_capture_folder.h"
#include "tests/drivers/simulated/bare_room.h"
#include "tools/configuration/rig_file.h"

namespace sparsight::testing {

// A walk in the bare room with all that the rig gave; the shared one takes two seconds and is large
// enough to be tracked.
struct MadeWalk {
  std::vector<RigEvent> events;
  RigConfig rig;
  std::unique_ptr<SimulatedRig> simulation;  // for its truth

  static MadeWalk of(const SimulationOptions& options) {
    MadeWalk walk;
    walk.simulation = std::make_unique<SimulatedRig>(options, bare_room());
    walk.events = gather_events(*walk.simulation).all;
    walk.rig = walk.simulation->rig_config();
    return walk;
  }
  static const MadeWalk& shared() {
    static const MadeWalk kWalk = [] {
      SimulationOptions options = small_options(2.0);
      options.width = 240;
      options.height = 180;
      return of(options);
    }();
    return kWalk;
  }
};

// Host time to the clock of the machine that captured.
inline constexpr std::chrono::seconds kSince1970{1'700'000'000};

template <typename Packet>
void capture_packet(MadeCapture& capture, std::uint16_t port, const Packet& packet) {
  const auto at = packet.arrival.time_since_epoch() + kSince1970;
  const auto seconds = std::chrono::floor<std::chrono::seconds>(at);
  const auto fraction = std::chrono::floor<std::chrono::microseconds>(at - seconds);
  capture.add(static_cast<std::uint32_t>(seconds.count()),
              static_cast<std::uint32_t>(fraction.count()),
              frame_of({.port = port, .payload = {packet.payload.begin(), packet.payload.end()}}));
}

// The walk as somebody without this program would have recorded it.
inline void write_capture_folder(const std::filesystem::path& folder, const MadeWalk& walk) {
  MadeCapture capture;
  std::string times = "# middle of the exposure\n";
  std::size_t frames = 0;
  for (const RigEvent& event : walk.events) {
    if (const auto* packet = std::get_if<LidarPacket>(&event)) {
      capture_packet(capture, 2368, *packet);
    } else if (const auto* position = std::get_if<PositionPacket>(&event)) {
      capture_packet(capture, 8308, *position);
    } else if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event)) {
      const cv::Mat image((*frame)->height, (*frame)->width, CV_8UC1,
                          const_cast<std::uint8_t*>((*frame)->bytes.data()));
      write_image(folder / "images" / fmt::format("{}.png", frames), image);
      const HostTime exposure = walk.simulation->ground_truth().exposures()[frames++];
      times += fmt::format("{:.7f}\n", to_seconds(exposure.time_since_epoch() + kSince1970));
    }
  }
  write_capture(folder / "lidar.pcap", capture);
  write_file(folder / "times.txt", times);
  write_file(folder / "rig.toml", describe(walk.rig));
}

inline void write_recording(const std::filesystem::path& file, const std::vector<RigEvent>& events,
                            const RigConfig& rig) {
  std::filesystem::remove(file);
  RecordingContent content;
  content.calibration = rig.calibration;
  content.attachments.push_back({kRigConfigurationAttachment, "application/toml", describe(rig)});
  McapWriterOptions options;
  options.sync_chunks = false;
  auto writer = RecordingWriter::create(file, content, options).value();
  for (const RigEvent& event : events) ASSERT_TRUE(writer->write(event));
  ASSERT_TRUE(writer->close());
}

}  // namespace sparsight::testing
