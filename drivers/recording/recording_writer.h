#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/recording/mcap_writer.h"
#include "drivers/recording/pose_messages.h"
#include "drivers/recording/recording_topics.h"
#include "drivers/recording/state_messages.h"
#include "hal/calibration.h"
#include "hal/result.h"
#include "hal/rig_event.h"

namespace sparsight {

struct RecordingAttachment {
  std::string name;
  std::string media_type;
  std::string content;
};

// Under this name the rig's configuration travels with what was recorded with it.
inline constexpr const char* kRigConfigurationAttachment = "rig.toml";
// The metadata record of that name says on which clock the recording is.
inline constexpr const char* kSessionMetadata = "sparsight";
inline constexpr const char* kUtcOffsetKey = "utc_minus_monotonic_ns";

// What a recording holds besides what happened.
struct RecordingContent {
  std::vector<RecordingAttachment> attachments;
  std::optional<RigCalibration> calibration;           // for /camera/camera_info and /tf_static
  std::optional<std::chrono::nanoseconds> utc_offset;  // UTC minus host time, as of the start
  std::map<std::string, std::string> session;          // anything else worth knowing
};

// CLOCK_REALTIME minus CLOCK_MONOTONIC, now.
std::chrono::nanoseconds current_utc_offset();

// Writes a recording: an MCAP file of profile "ros2" with everything raw, in the order of the
// calls, and what was made of it. Same calls, same bytes. Thread-bound, blocks on the disk; a live
// rig uses a Recorder.
//
// An error is final (see McapWriter) and told by every call after it.
class RecordingWriter {
 public:
  static Result<std::unique_ptr<RecordingWriter>> create(
      const std::filesystem::path& path, const RecordingContent& content,
      const McapWriterOptions& options = {}, ExistingFile existing = ExistingFile::kRefuse);
  // The same on a given file; `name` is for error messages.
  static Result<std::unique_ptr<RecordingWriter>> start(std::unique_ptr<OutputFile> file,
                                                        std::string name,
                                                        const RecordingContent& content,
                                                        const McapWriterOptions& options = {});

  Result<void> write(const RigEvent& event);
  Result<void> write(const RecordedPose& pose);  // as /pose, /map_pose and /tf
  Result<void> write(const RecordedSyncState& state);
  Result<void> flush();
  // Completes the file with its index. Without it (a crash), recover_recording() does it later.
  Result<void> close();

  McapWriter& mcap() { return mcap_; }

 private:
  RecordingWriter(std::unique_ptr<OutputFile> file, std::string name,
                  const RecordingContent& content, const McapWriterOptions& options);

  void describe(const RecordingContent& content);
  std::uint16_t channel(RecordingTopic topic);
  void write_frame(const CameraFrame& frame);
  void write_static_transforms();
  template <typename Append>
  void message(RecordingTopic topic, HostTime published, Append append);
  Result<void> outcome(std::error_code error) const;

  McapWriter mcap_;
  const std::string name_;
  const std::optional<RigCalibration> calibration_;
  bool begun_ = false;
  HostTime now_;  // log time: arrival of the latest event
  std::map<std::string, std::uint16_t, std::less<>> schemas_;
  std::array<std::optional<std::uint16_t>, kRecordingTopics> channels_;
  std::array<std::uint32_t, kRecordingTopics> sequences_{};
};

}  // namespace sparsight
