#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "hal/result.h"
#include "tools/benchmark/kitti_sequences.h"

namespace sparsight {

// One replay of the benchmark: a sequence with a number of rays.
struct ReplayRun {
  KittiSequence sequence;
  int rays = 0;
  std::string profile;                    // as `replay --profile` takes it
  std::optional<std::size_t> max_frames;  // as `replay --max-frames` takes it
  std::filesystem::path session;          // the session folder it makes

  std::filesystem::path log() const { return session.string() + ".log"; }
  std::filesystem::path stamp() const { return session.string() + ".settings.json"; }
  std::size_t frames() const;  // that it will replay
};

struct ReplayOutcome {
  enum class Status : std::uint8_t { kDone, kFailed, kInterrupted };
  Status status = Status::kDone;
  std::string message;  // why it failed
};

// What a replay in progress is told and asked.
struct ReplayWatch {
  std::function<void(std::size_t frames_done)> on_progress;
  std::function<bool()> interrupted;
};

// Carries out a run and returns when it has ended.
using ReplayRunner = std::function<ReplayOutcome(const ReplayRun&, const ReplayWatch&)>;

// Everything the figures of a run depend on, as text. Two runs of the same text give the same
// figures: `program` identifies the executable, `profile` is the resolved configuration.
std::string run_settings(const ReplayRun& run, const std::string& program,
                         const std::string& profile);

// Whether the session read its source to the end (session.json says so).
bool session_is_complete(const ReplayRun& run);

// A run is finished if its session says it is complete and the stamp beside it, which is written
// last, has these settings.
bool is_finished(const ReplayRun& run, const std::string& settings);
Result<void> begin_run(const ReplayRun& run);  // removes the stamp
Result<void> finish_run(const ReplayRun& run, const std::string& settings);

}  // namespace sparsight
