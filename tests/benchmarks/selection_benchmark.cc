#include "slam/points/camera_returns.h"
#include "slam/points/point_selection.h"
#include "slam/points/visibility.h"
#include "slam/tracking/patch_set.h"
#include "tests/benchmarks/made_drive.h"

namespace sparsight {
namespace {

void project_returns(benchmark::State& state) {
  const MadeDrive& drive = made_drive(static_cast<int>(state.range(0)));
  std::size_t seen = 0;
  for (auto _ : state) {
    const std::vector<CameraReturn> returns = drive.returns(0);
    seen = returns.size();
    benchmark::DoNotOptimize(returns.data());
  }
  state.counters["returns"] = static_cast<double>(drive.frames.front().sweep.returns.size());
  state.counters["in_image"] = static_cast<double>(seen);
}
BENCHMARK(project_returns)->Apply(each_drive);

void select(benchmark::State& state, bool surface_slope) {
  const MadeDrive& drive = made_drive(static_cast<int>(state.range(0)));
  const std::vector<CameraReturn> returns = drive.returns(0);
  const CameraModel camera(drive.scene.rig.camera);
  PointSelectionConfig config;
  config.surface_slope = surface_slope;
  std::size_t selected = 0;
  for (auto _ : state) {
    const auto points = select_points(returns, hidden_from_camera(returns, camera),
                                      drive.frames.front().grey, camera, config);
    selected = points.size();
    benchmark::DoNotOptimize(points.data());
  }
  state.counters["points"] = static_cast<double>(selected);
}
BENCHMARK_CAPTURE(select, flat, false)->Apply(each_drive);
BENCHMARK_CAPTURE(select, surface_slope, true)->Apply(each_drive);

void make_patches_of_all_levels(benchmark::State& state) {
  const MadeDrive& drive = made_drive(static_cast<int>(state.range(0)));
  const CameraModel camera(drive.scene.rig.camera);
  const std::unique_ptr<Keyframe> keyframe = drive.keyframe(0);
  for (auto _ : state) {
    for (int level = 0; level < keyframe->pyramid.levels(); ++level) {
      benchmark::DoNotOptimize(make_patches(keyframe->pyramid, level, camera, keyframe->points,
                                            drive.photometry.gradient_weight_constant));
    }
  }
  state.counters["points"] = static_cast<double>(keyframe->points.size());
}
BENCHMARK(make_patches_of_all_levels)->Apply(each_drive);

}  // namespace
}  // namespace sparsight
