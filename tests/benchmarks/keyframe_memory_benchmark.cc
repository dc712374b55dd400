#include <benchmark/benchmark.h>

#include <filesystem>

#include "slam/loop/loop_closer.h"
#include "tests/tools/map/made_keyframe.h"
#include "tools/loop/vocabulary_file.h"
#include "tools/map/paged_keyframes.h"
#include "tools/session/process_load.h"

// Hours of walking: what thousands of keyframes of 800 x 600 cost in memory and on the disk. None
// is like another, so that the inverted file is as full as it gets and nothing is verified.
namespace sparsight {
namespace {

void keep_keyframes(benchmark::State& state) {
  const auto count = static_cast<std::uint64_t>(state.range(0));
  for (auto _ : state) {
    const auto file = std::filesystem::temp_directory_path() / "sparsight_keyframe_memory";
    const auto keyframes = std::make_shared<PagedKeyframes>();
    keyframes->write_to(KeyframeFile::create(file).value());
    LoopCloser loops(OdometryConfig{}, built_in_vocabulary(), keyframes);
    std::uint64_t before = 0;
    for (std::uint64_t i = 0; i < count + 100; ++i) {
      if (i == 100) before = resident_bytes();
      loops.add(testing::made_keyframe(i), {800, 600, 400, 400, 399.5, 299.5});
    }
    const double kept = static_cast<double>(count);
    state.counters["resident_kB_each"] =
        1e-3 * (static_cast<double>(resident_bytes()) - static_cast<double>(before)) / kept;
    state.counters["disk_kB_each"] =
        1e-3 * static_cast<double>(std::filesystem::file_size(file)) / kept;
    std::filesystem::remove(file);
  }
}

}  // namespace
}  // namespace sparsight

BENCHMARK(sparsight::keep_keyframes)->Arg(3000)->Iterations(1)->Unit(benchmark::kSecond);
