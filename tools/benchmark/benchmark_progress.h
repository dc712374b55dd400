#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "tools/benchmark/benchmark.h"
#include "tools/session/progress.h"

namespace sparsight {

// How many frames are to do, how many are done, and what that says about the time left.
class FrameTally {
 public:
  explicit FrameTally(const std::vector<BenchmarkEntry>& entries);

  void advance(std::size_t entry, std::size_t frames_done);
  // A run that ended early takes its remaining frames out of the sum.
  void end(std::size_t entry);

  std::size_t total() const;
  std::size_t done() const;
  // "1:02:03"; "?" until a frame is done.
  std::string time_left(std::chrono::nanoseconds elapsed) const;

 private:
  struct Frames {
    std::size_t total = 0;
    std::size_t done = 0;
  };
  std::vector<Frames> frames_;
};

// The benchmark's progress for a person: one line that is rewritten on a terminal, a line per run
// elsewhere. Thread-bound; as BenchmarkWatch calls it, by one thread at a time.
class BenchmarkProgress {
 public:
  BenchmarkProgress(std::FILE* stream, Progress::Style style);

  void plan(const std::vector<BenchmarkEntry>& entries);
  void begin(std::size_t entry);
  void progress(std::size_t entry, std::size_t frames_done);
  void end(std::size_t entry, const BenchmarkEntry& result);

 private:
  void say(const std::string& text);
  void rewrite_line();

  std::FILE* stream_;
  Progress::Style style_;
  std::vector<std::string> names_;
  FrameTally tally_{{}};
  std::map<std::size_t, std::size_t> running_;  // entry to frames done
  std::size_t runs_to_do_ = 0;
  std::size_t runs_ended_ = 0;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace sparsight
