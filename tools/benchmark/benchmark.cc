#include "tools/benchmark/benchmark.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <thread>

namespace sparsight {
namespace {

using Status = BenchmarkEntry::Status;

std::vector<BenchmarkEntry> plan(const KittiSequences& sequences, const BenchmarkOptions& options) {
  std::vector<BenchmarkEntry> entries;
  for (const KittiSequence& sequence : sequences.found) {
    for (const int rays : options.rays) {
      entries.push_back(
          {.run = {.sequence = sequence,
                   .rays = rays,
                   .profile = options.profile,
                   .max_frames = options.max_frames,
                   .session = options.output / fmt::format("{}-{}rays", sequence.name, rays)}});
    }
  }
  return entries;
}

void take_figures(BenchmarkEntry& entry) {
  auto figures = read_run_figures(entry.run);
  if (figures) {
    entry.status = Status::kDone;
    entry.figures = *std::move(figures);
  } else {
    entry.status = Status::kFailed;
    entry.message = figures.error().message;
  }
}

// One call of run_benchmark(), shared by its threads.
class BenchmarkRunner {
 public:
  BenchmarkRunner(Benchmark& benchmark, const ReplayRunner& runner, const BenchmarkWatch& watch)
      : benchmark_(benchmark), runner_(runner), watch_(watch) {}

  void take_finished() {
    for (BenchmarkEntry& entry : benchmark_.entries) {
      if (is_finished(entry.run, settings(entry))) {
        take_figures(entry);
        entry.resumed = entry.status == Status::kDone;
        entry.status = entry.resumed ? Status::kDone : Status::kNotRun;
      }
    }
  }

  void work() {
    while (const auto index = next()) {
      BenchmarkEntry entry = benchmark_.entries[*index];
      execute(*index, entry);
      const std::lock_guard lock(mutex_);
      benchmark_.entries[*index] = entry;
      watch_.on_end(*index, entry);
    }
  }

 private:
  std::string settings(const BenchmarkEntry& entry) const {
    return run_settings(entry.run, benchmark_.options.program, benchmark_.options.profile_text);
  }

  std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    while (next_ < benchmark_.entries.size() && benchmark_.entries[next_].resumed) ++next_;
    if (next_ == benchmark_.entries.size() || watch_.interrupted()) return std::nullopt;
    watch_.on_begin(next_);
    return next_++;
  }

  void execute(std::size_t index, BenchmarkEntry& entry) {
    entry.message.clear();
    const auto on_progress = [&](std::size_t frames_done) {
      const std::lock_guard lock(mutex_);
      watch_.on_progress(index, frames_done);
    };
    ReplayOutcome outcome;
    if (auto begun = begin_run(entry.run); !begun) {
      outcome = {ReplayOutcome::Status::kFailed, begun.error().message};
    } else {
      outcome = runner_(entry.run, {.on_progress = on_progress, .interrupted = watch_.interrupted});
    }
    conclude(outcome, entry);
  }

  void conclude(const ReplayOutcome& outcome, BenchmarkEntry& entry) const {
    if (outcome.status == ReplayOutcome::Status::kInterrupted) return;
    if (outcome.status == ReplayOutcome::Status::kFailed) {
      entry.status = Status::kFailed;
      entry.message = outcome.message;
      return;
    }
    if (!session_is_complete(entry.run)) {
      entry.status = Status::kFailed;
      entry.message =
          fmt::format("{}: the session ended before its source did", entry.run.session.string());
      return;
    }
    take_figures(entry);
    if (entry.status != Status::kDone) return;
    if (auto stamped = finish_run(entry.run, settings(entry)); !stamped) {
      entry.status = Status::kFailed;
      entry.message = stamped.error().message;
    }
  }

  Benchmark& benchmark_;
  const ReplayRunner& runner_;
  const BenchmarkWatch& watch_;
  std::mutex mutex_;  // guards benchmark_.entries, next_ and calls of watch_
  std::size_t next_ = 0;
};

}  // namespace

bool Benchmark::all_done() const {
  return std::ranges::all_of(entries,
                             [](const auto& entry) { return entry.status == Status::kDone; });
}

bool Benchmark::interrupted() const {
  return std::ranges::any_of(entries,
                             [](const auto& entry) { return entry.status == Status::kNotRun; });
}

Benchmark run_benchmark(const KittiSequences& sequences, const BenchmarkOptions& options,
                        const ReplayRunner& runner, const BenchmarkWatch& watch) {
  Benchmark benchmark{
      .options = options, .entries = plan(sequences, options), .notes = sequences.notes};
  BenchmarkRunner work(benchmark, runner, watch);
  work.take_finished();
  watch.on_plan(benchmark.entries);
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < options.jobs; ++i) threads.emplace_back([&work] { work.work(); });
  work.work();
  threads.clear();  // waits for them
  return benchmark;
}

}  // namespace sparsight
