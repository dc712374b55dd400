#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "drivers/recording/recording_writer.h"
#include "hal/result.h"
#include "hal/rig_event.h"

namespace sparsight {

struct RecorderConfig {
  McapWriterOptions file;
  // What waits for the disk: 5 s of the widest stream, 30 frames of 960 KB a second and the LiDAR.
  std::size_t queue_bytes = std::size_t{160} << 20;
  std::uint64_t free_space_floor_bytes = std::uint64_t{1} << 30;
  std::chrono::milliseconds space_interval{1000};  // how often the free space is looked at
};

enum class RecorderState : std::uint8_t {
  kRecording,
  kFinished,
  kFloorReached,  // ended cleanly, as little space is left
  kDiskFull,
  kDiskFailed,  // gone, or broken
};

struct RecorderReport {
  RecorderState state = RecorderState::kRecording;
  std::string message;  // for a person, where the state is none of the first two
  std::uint64_t events_accepted = 0;
  std::uint64_t preview_dropped = 0;  // poses and sync states: they can be made again
  std::uint64_t frames_dropped = 0;   // raw, for want of queue: the disk is too slow
  std::uint64_t packets_dropped = 0;  // anything else raw, likewise
  std::uint64_t events_refused = 0;   // handed over after the recording had ended
  std::uint64_t messages_lost = 0;    // taken, and lost to an error of the disk
  std::uint64_t bytes_written = 0;
  std::size_t queued_bytes = 0;
  std::size_t most_queued_bytes = 0;
  std::chrono::nanoseconds slowest_write{0};
  std::optional<std::uint64_t> free_bytes;

  bool lost_anything_raw() const { return frames_dropped + packets_dropped + messages_lost > 0; }
};

// Records a live rig. Thread-safe: any thread hands over what it has and goes on; one thread of the
// recorder's own writes. Not real-time-safe: handing over takes a lock for moments and may
// allocate.
//
// What waits is bounded. When it grows, previews are left out first; a disk that stands still for
// longer than the queue lasts costs frames, and only after them packets and edges.
class Recorder {
 public:
  static Result<std::unique_ptr<Recorder>> create(const std::filesystem::path& path,
                                                  const RecordingContent& content,
                                                  const RecorderConfig& config = {});
  // The same on a given file; `name` is for error messages.
  static Result<std::unique_ptr<Recorder>> start(std::unique_ptr<OutputFile> file, std::string name,
                                                 const RecordingContent& content,
                                                 const RecorderConfig& config = {});
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // False if it was not taken: the report says why.
  bool record(RigEvent event);
  bool record(const RecordedPose& pose);
  bool record(const RecordedSyncState& state);

  RecorderReport report() const;
  // Writes what is queued, completes the file. Further calls report the same.
  RecorderReport finish();

 private:
  using Entry = std::variant<RigEvent, RecordedPose, RecordedSyncState>;
  using Clock = std::chrono::steady_clock;

  Recorder(std::unique_ptr<RecordingWriter> writer, const RecorderConfig& config);

  bool accept(Entry entry);
  bool has_room(const Entry& entry, std::size_t bytes);
  std::optional<Entry> take();
  void run();
  void write(const Entry& entry);
  void keep_pace();
  void watch_space();
  void end(RecorderState state, std::string message);

  const std::unique_ptr<RecordingWriter> writer_;  // the writing thread's alone once it runs
  const RecorderConfig config_;
  Clock::time_point last_flush_ = Clock::now();  // likewise
  Clock::time_point last_look_ = Clock::now();
  std::uint64_t flushed_bytes_ = 0;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<Entry> queue_;
  RecorderReport report_;
  bool stopping_ = false;

  std::thread thread_;  // last, so that it finds the rest constructed
};

}  // namespace sparsight
