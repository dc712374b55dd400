#include "slam/tracking/patch_agreement.h"
#include "slam/tracking/photometric_kernel.h"
#include "slam/tracking/robust_model.h"
#include "slam/tracking/tracker.h"
#include "tests/benchmarks/made_drive.h"

namespace sparsight {
namespace {

// The frame after a keyframe, expected where a constant motion would be wrong by some pixels.
struct Scenario {
  explicit Scenario(const benchmark::State& state)
      : drive(made_drive(static_cast<int>(state.range(0)))),
        camera(drive.scene.rig.camera),
        keyframe(drive.keyframe(0)),
        next(drive.frames[1].grey, MadeDrive::kLevels) {
    const Eigen::Isometry3d T_keyframe_camera =
        drive.T_world_camera[0].inverse() * drive.T_world_camera[1];
    Vector6d error;
    error << 0.002, 0.004, -0.002, 0.01, 0.005, 0.03;
    start.T_keyframe_predicted = T_keyframe_camera * exp_se3(error);
    linearize(keyframe->patches.front(), next.level(0), camera, T_keyframe_camera.inverse(), {},
              linearization);
  }
  const PatchSet& patches() const { return keyframe->patches.front(); }

  const MadeDrive& drive;
  CameraModel camera;
  std::unique_ptr<Keyframe> keyframe;
  ImagePyramid next;
  TrackingStart start;
  Linearization linearization;
};

template <typename Tracked>
void track_by(benchmark::State& state, const Tracked& tracked) {
  Scenario s(state);
  s.start.error_px = 8.0;
  TrackerConfig config;
  config.automatic_top_level = true;
  Tracker tracker(s.camera, config, s.drive.photometry);
  TrackingResult result;
  for (auto _ : state) result = tracked(tracker, s);
  if (!result.ok()) state.SkipWithError("tracking failed: nothing was measured");
  state.counters["points"] = result.points_used;
  state.counters["starts"] = result.attempts;
}
void track(benchmark::State& state) {
  track_by(state, [](Tracker& tracker, const Scenario& s) {
    return tracker.track(*s.keyframe, s.next, s.start);
  });
}
BENCHMARK(track)->Apply(each_drive);

// What a first frame adds that finds too little at once, and one after a failure: every starting
// motion is considered.
void search_all_starting_motions(benchmark::State& state) {
  track_by(state, [](Tracker& tracker, const Scenario& s) {
    return tracker.search(*s.keyframe, s.next, s.start, {});
  });
}
BENCHMARK(search_all_starting_motions)->Apply(each_drive);

void linearize_patches(benchmark::State& state) {
  Scenario s(state);
  for (auto _ : state) {
    linearize(s.patches(), s.next.level(0), s.camera, s.start.T_keyframe_predicted.inverse(), {},
              s.linearization);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(s.patches().entries()));
}
BENCHMARK(linearize_patches)->Apply(each_drive);

void accumulate_normal_equations(benchmark::State& state) {
  Scenario s(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(accumulate(s.patches(), s.linearization, 5.0, 8.0));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(s.patches().entries()));
}
BENCHMARK(accumulate_normal_equations)->Apply(each_drive);

void estimate_scale(benchmark::State& state) {
  Scenario s(state);
  for (auto _ : state) benchmark::DoNotOptimize(estimate_sigma(s.linearization, 5.0, 5.0));
}
BENCHMARK(estimate_scale)->Apply(each_drive);

void robust_cost_of_patches(benchmark::State& state) {
  Scenario s(state);
  for (auto _ : state) benchmark::DoNotOptimize(robust_cost(s.linearization, 5.0, 8.0));
}
BENCHMARK(robust_cost_of_patches)->Apply(each_drive);

// Scale, cost and normal equations with one weight per patch.
void weigh_per_patch(benchmark::State& state) {
  Scenario s(state);
  PhotometryConfig photometry = s.drive.photometry;
  photometry.patch_weights = true;
  for (auto _ : state) {
    sum_patches(s.linearization);
    const double sigma = estimate_sigma(s.linearization, photometry, 5.0);
    benchmark::DoNotOptimize(robust_cost(s.linearization, photometry, sigma));
    benchmark::DoNotOptimize(accumulate(s.patches(), s.linearization, photometry, sigma));
  }
}
BENCHMARK(weigh_per_patch)->Apply(each_drive);

void agreement_of_patches(benchmark::State& state) {
  Scenario s(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(patch_agreement(s.patches(), s.linearization, {}));
  }
}
BENCHMARK(agreement_of_patches)->Apply(each_drive);

}  // namespace
}  // namespace sparsight
