#include "tools/benchmark/benchmark_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hal/time.h"

namespace sparsight {
namespace {

std::string name_of(const ReplayRun& run) {
  return fmt::format("{} with {} rays", run.sequence.name, run.rays);
}

std::string result_of(const BenchmarkEntry& entry) {
  switch (entry.status) {
    case BenchmarkEntry::Status::kFailed:
      return "FAILED: " + entry.message;
    case BenchmarkEntry::Status::kNotRun:
      return "interrupted";
    case BenchmarkEntry::Status::kDone:
      break;
  }
  if (!entry.figures.accuracy) return "done, no ground truth";
  const Evaluation& evaluation = entry.figures.accuracy->evaluation;
  const auto t_rel = evaluation.kitti.t_rel_percent;
  return fmt::format("t_rel {}  ATE {:.3f} m", t_rel ? fmt::format("{:.2f} %", *t_rel) : "none",
                     evaluation.ate.rmse_m);
}

}  // namespace

FrameTally::FrameTally(const std::vector<BenchmarkEntry>& entries) {
  for (const BenchmarkEntry& entry : entries) {
    frames_.push_back({entry.resumed ? 0 : entry.run.frames(), 0});
  }
}

void FrameTally::advance(std::size_t entry, std::size_t frames_done) {
  Frames& frames = frames_[entry];
  frames.done = std::clamp(frames_done, frames.done, frames.total);
}

void FrameTally::end(std::size_t entry) { frames_[entry].total = frames_[entry].done; }

std::size_t FrameTally::total() const {
  std::size_t sum = 0;
  for (const Frames& frames : frames_) sum += frames.total;
  return sum;
}

std::size_t FrameTally::done() const {
  std::size_t sum = 0;
  for (const Frames& frames : frames_) sum += frames.done;
  return sum;
}

std::string FrameTally::time_left(std::chrono::nanoseconds elapsed) const {
  if (done() == 0) return "?";
  const double seconds_per_frame = to_seconds(elapsed) / static_cast<double>(done());
  const auto left =
      static_cast<long>(std::ceil(seconds_per_frame * static_cast<double>(total() - done())));
  return fmt::format("{}:{:02}:{:02}", left / 3600, left / 60 % 60, left % 60);
}

BenchmarkProgress::BenchmarkProgress(std::FILE* stream, Progress::Style style)
    : stream_(stream), style_(style), start_(std::chrono::steady_clock::now()) {}

void BenchmarkProgress::plan(const std::vector<BenchmarkEntry>& entries) {
  tally_ = FrameTally(entries);
  for (const BenchmarkEntry& entry : entries) {
    names_.push_back(name_of(entry.run));
    runs_to_do_ += entry.resumed ? 0 : 1;
  }
  say(fmt::format("{} runs: {} finished earlier, {} to do, {} frames", entries.size(),
                  entries.size() - runs_to_do_, runs_to_do_, tally_.total()));
}

void BenchmarkProgress::begin(std::size_t entry) {
  running_[entry] = 0;
  rewrite_line();
}

void BenchmarkProgress::progress(std::size_t entry, std::size_t frames_done) {
  // The journal is renamed at the end of a run and then no longer found: never count back.
  running_[entry] = std::max(running_[entry], frames_done);
  tally_.advance(entry, frames_done);
  rewrite_line();
}

void BenchmarkProgress::end(std::size_t entry, const BenchmarkEntry& result) {
  ++runs_ended_;
  running_.erase(entry);
  if (result.status == BenchmarkEntry::Status::kDone) {
    tally_.advance(entry, result.run.frames());
  }
  tally_.end(entry);
  say(fmt::format("{}/{}  {}: {}  ({} left)", runs_ended_, runs_to_do_, names_[entry],
                  result_of(result), tally_.time_left(std::chrono::steady_clock::now() - start_)));
  if (!running_.empty()) rewrite_line();
}

void BenchmarkProgress::say(const std::string& text) {
  if (style_ == Progress::Style::kQuiet) return;
  fmt::print(stream_, "{}{}\n", style_ == Progress::Style::kTerminal ? "\r\x1b[K" : "", text);
  std::fflush(stream_);
}

void BenchmarkProgress::rewrite_line() {
  if (style_ != Progress::Style::kTerminal) return;
  std::string line;
  for (const auto& [entry, frames_done] : running_) {
    line += fmt::format("{}: frame {}  ", names_[entry], frames_done);
  }
  const std::size_t percent = tally_.total() == 0 ? 100 : 100 * tally_.done() / tally_.total();
  fmt::print(stream_, "\r{}| run {}/{}  {} %  {} left\x1b[K", line, runs_ended_ + running_.size(),
             runs_to_do_, percent, tally_.time_left(std::chrono::steady_clock::now() - start_));
  std::fflush(stream_);
}

}  // namespace sparsight
