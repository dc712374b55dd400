#include "slam/window/window_optimizer.h"
#include "tests/benchmarks/made_drive.h"

namespace sparsight {
namespace {

// As far off as tracking leaves a keyframe, a different way each.
Vector6d small_error(std::size_t frame) {
  const double sign = frame % 2 == 0 ? 1.0 : -1.0;
  Vector6d error;
  error << 0.0005, sign * 0.001, -0.0005, sign * 0.01, 0.005, 0.01;
  return error;
}

WindowOptimizer window_of(const MadeDrive& drive, int size) {
  WindowConfig config;
  config.size = size - 1;  // so that the oldest leaves when the window holds `size`
  WindowOptimizer window(CameraModel(drive.scene.rig.camera), config, drive.photometry);
  for (std::size_t frame = 0; frame < static_cast<std::size_t>(size); ++frame) {
    std::unique_ptr<Keyframe> keyframe = drive.keyframe(frame);
    if (frame > 0)
      keyframe->T_world_camera = keyframe->T_world_camera * exp_se3(small_error(frame));
    window.add(std::move(keyframe));
  }
  return window;
}

// What a new keyframe costs: optimisation of a window that nobody has optimised before, and the
// leave of the oldest.
void optimize_window(benchmark::State& state) {
  const MadeDrive& drive = made_drive(static_cast<int>(state.range(0)));
  WindowSummary summary;
  for (auto _ : state) {
    state.PauseTiming();
    WindowOptimizer window = window_of(drive, static_cast<int>(state.range(1)));
    state.ResumeTiming();
    summary = window.optimize();
    benchmark::DoNotOptimize(window.marginalize_oldest());
    state.PauseTiming();
    { const WindowOptimizer freed = std::move(window); }
    state.ResumeTiming();
  }
  state.counters["pairs"] = summary.pairs;
  state.counters["iterations"] = summary.iterations;
}
BENCHMARK(optimize_window)
    ->ArgNames({"hall", "keyframes"})
    ->ArgsProduct({{kStreet, kHall}, {5, 7}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sparsight
