#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "drivers/recording/recorder.h"
#include "drivers/recording/recording_source.h"
#include "tests/benchmarks/made_drive.h"
#include "tests/benchmarks/made_rig_data.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::chrono::seconds kDuration{4};

// 800 x 600 at 30 Hz with both edges of every exposure, and a VLP-16.
const std::vector<RigEvent>& rig_events() {
  static const std::vector<RigEvent> kEvents = [] {
    std::mt19937 random(1);
    const GreyImage& hall = made_drive(kHall).frames.front().grey;
    std::vector<RigEvent> events;
    for (HostTime t(0s); t < HostTime(kDuration); t += 33'333'333ns) {
      auto frame = noisy_frame(hall, random);
      frame->driver_time = frame->arrival = t + 12ms;
      events.emplace_back(Edge{EdgeLine::kExposure, true, t});
      events.emplace_back(Edge{EdgeLine::kExposure, false, t + 4ms});
      events.emplace_back(std::shared_ptr<const CameraFrame>(std::move(frame)));
    }
    for (HostTime t(0s); t < HostTime(kDuration); t += 1'327'104ns) {
      events.emplace_back(made_packet(t, random));
    }
    std::ranges::stable_sort(
        events, [](const auto& a, const auto& b) { return arrival_of(a) < arrival_of(b); });
    return events;
  }();
  return kEvents;
}

fs::path recording_path() {
  return fs::temp_directory_path() / ("sparsight_benchmark_" + std::to_string(getpid()) + ".mcap");
}

RecorderConfig packed_with(Compression compression) {
  RecorderConfig config;
  config.file.compression = compression;
  config.queue_bytes = std::size_t{1} << 30;  // all comes at once here
  config.free_space_floor_bytes = 0;
  return config;
}

RecorderReport record_all(const RecorderConfig& config) {
  auto recorder = Recorder::create(recording_path(), {}, config);
  if (!recorder) return {};
  for (const RigEvent& event : rig_events()) (*recorder)->record(event);
  return (*recorder)->finish();
}

// All of it: handing over, packing, checksums, system calls, syncing. One core is 100 %.
void record_rig(benchmark::State& state) {
  const RecorderConfig config = packed_with(static_cast<Compression>(state.range(0)));
  rig_events();
  double used = 0.0;
  RecorderReport report;
  for (auto _ : state) {
    const double start = processor_seconds();
    report = record_all(config);
    used += processor_seconds() - start;
    state.PauseTiming();
    fs::remove(recording_path());
    state.ResumeTiming();
  }
  if (report.bytes_written == 0 || report.lost_anything_raw())
    state.SkipWithError("nothing recorded");
  const auto recorded = static_cast<double>(state.iterations()) * to_seconds(kDuration);
  state.counters["percent_of_a_core"] = 100.0 * used / recorded;
  state.counters["MB_per_s"] =
      1e-6 * static_cast<double>(report.bytes_written) / to_seconds(kDuration);
}

void replay_rig(benchmark::State& state) {
  record_all(packed_with(static_cast<Compression>(state.range(0))));
  double used = 0.0;
  for (auto _ : state) {
    const double start = processor_seconds();
    auto source = RecordingSource::open(recording_path());
    std::size_t count = 0;
    while ((*source)->next()) ++count;
    if (count != rig_events().size()) state.SkipWithError("events are missing");
    used += processor_seconds() - start;
  }
  fs::remove(recording_path());
  const auto replayed = static_cast<double>(state.iterations()) * to_seconds(kDuration);
  state.counters["times_real_time"] = replayed / used;
}

void each_compression(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("compression")->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const Compression each : {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    benchmark->Arg(static_cast<int>(each));
  }
}

BENCHMARK(record_rig)->Apply(each_compression);
BENCHMARK(replay_rig)->Apply(each_compression);

}  // namespace
}  // namespace sparsight
