#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/recording/input_file.h"
#include "drivers/recording/output_file.h"
#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"

namespace sparsight::testing {

// A disk in memory that can be full, slow or gone.
struct MadeDisk {
  std::vector<std::uint8_t> bytes;
  std::uint64_t capacity = UINT64_MAX;
  std::atomic<std::uint64_t> free{UINT64_MAX};
  std::atomic<bool> gone{false};
  std::atomic<bool> stalled{false};
  std::atomic<int> syncs{0};
};

class MadeOutput final : public OutputFile {
 public:
  explicit MadeOutput(MadeDisk& disk) : disk_(disk) {}

  std::error_code write(Bytes bytes) override {
    while (disk_.stalled) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (disk_.gone) return std::make_error_code(std::errc::io_error);
    // As write(2): what fits is written, the rest meets the error.
    const std::uint64_t room = disk_.capacity - disk_.bytes.size();
    const std::size_t count = std::min<std::uint64_t>(room, bytes.size());
    disk_.bytes.insert(disk_.bytes.end(), bytes.begin(), bytes.begin() + static_cast<long>(count));
    return count == bytes.size() ? std::error_code()
                                 : std::make_error_code(std::errc::no_space_on_device);
  }
  std::error_code sync() override {
    ++disk_.syncs;
    return disk_.gone ? std::make_error_code(std::errc::io_error) : std::error_code();
  }
  std::error_code truncate(std::uint64_t size) override {
    if (disk_.gone) return std::make_error_code(std::errc::io_error);
    disk_.bytes.resize(size);
    return {};
  }
  std::optional<std::uint64_t> free_bytes() const override { return disk_.free.load(); }

 private:
  MadeDisk& disk_;
};

inline RecordingContent made_content() {
  RecordingContent content;
  content.attachments.push_back(
      {kRigConfigurationAttachment, "application/toml", "name = \"made\"\n"});
  content.calibration.emplace();
  content.calibration->camera = {40, 30, 35.0, 36.0, 19.5, 14.5, 0.1, -0.05, 0.001, 0.002, 0.01};
  content.calibration->T_camera_lidar.translation() << 0.1, 0.2, 0.3;
  content.utc_offset = std::chrono::nanoseconds(1'790'000'000'123'456'789);
  content.session["serial"] = "7";
  return content;
}

inline std::vector<std::uint8_t> recorded(const std::vector<RigEvent>& events,
                                          const McapWriterOptions& options = {}) {
  MadeDisk disk;
  auto writer = RecordingWriter::start(std::make_unique<MadeOutput>(disk), "made.mcap",
                                       made_content(), options);
  for (const RigEvent& event : events) EXPECT_TRUE((*writer)->write(event));
  EXPECT_TRUE((*writer)->close());
  return disk.bytes;
}

inline Result<std::unique_ptr<RecordingSource>> open_bytes(std::vector<std::uint8_t> bytes,
                                                           const RecordingOptions& options = {}) {
  return RecordingSource::open(input_from_memory(std::move(bytes)), "made.mcap", options);
}

// For the names of tests.
inline std::string compression_name(const ::testing::TestParamInfo<Compression>& info) {
  return info.param == Compression::kNone ? "stored" : std::string(mcap_name(info.param));
}

inline std::vector<RigEvent> all_events(RigEventSource& source) {
  std::vector<RigEvent> events;
  while (auto event = source.next()) events.push_back(std::move(*event));
  return events;
}

}  // namespace sparsight::testing
