#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hal/result.h"
#include "tools/benchmark/kitti_sequences.h"
#include "tools/benchmark/replay_run.h"
#include "tools/benchmark/run_figures.h"

namespace sparsight {

struct BenchmarkOptions {
  std::filesystem::path output;  // a session folder per run, and the report
  std::vector<int> rays = {64, 16, 8};
  std::string profile = "default";
  std::string profile_text;  // the resolved configuration: a run with another is not this run
  std::string program;       // fingerprint of the executable, for the same reason
  std::optional<std::size_t> max_frames;
  std::size_t jobs = 1;
};

struct BenchmarkEntry {
  enum class Status : std::uint8_t {
    kDone,
    kFailed,
    kNotRun,  // the benchmark was interrupted before or during it
  };
  ReplayRun run;
  Status status = Status::kNotRun;
  bool resumed = false;  // an earlier benchmark had finished it
  std::string message;   // why it failed
  RunFigures figures;    // if done
};

struct Benchmark {
  BenchmarkOptions options;
  std::vector<BenchmarkEntry> entries;  // sequence after sequence, rays in the order asked for
  std::vector<std::string> notes;

  bool all_done() const;
  bool interrupted() const;  // something is left for the next call
};

// Called as runs begin, go on and end, by one thread at a time; `entry` is the run's place in
// Benchmark::entries.
struct BenchmarkWatch {
  std::function<void(const std::vector<BenchmarkEntry>&)> on_plan;
  std::function<void(std::size_t entry)> on_begin;
  std::function<void(std::size_t entry, std::size_t frames_done)> on_progress;
  std::function<void(std::size_t entry, const BenchmarkEntry&)> on_end;
  std::function<bool()> interrupted;
};

// Runs every sequence with every number of rays, except what an earlier call with the same settings
// has finished. A run that fails does not stop the others.
Benchmark run_benchmark(const KittiSequences& sequences, const BenchmarkOptions& options,
                        const ReplayRunner& runner, const BenchmarkWatch& watch);

}  // namespace sparsight
