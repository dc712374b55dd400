#include "realtime/sync/edge_matcher.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "tests/realtime/sync/made_camera.h"

namespace sparsight {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

EdgeMatcherConfig matcher_config(const MadeCameraOptions& camera) {
  return {.exposure_active = camera.exposure_active, .trigger_delay = camera.trigger_delay};
}

struct MatcherRun {
  std::vector<StampedFrame> frames;
  CameraSyncState state;
  const MadeCamera* camera;

  nanoseconds error(std::size_t i) const {
    return frames[i].stamp.mapped - camera->middle_of(*frames[i].frame);
  }
  std::size_t count(StampQuality quality) const {
    return static_cast<std::size_t>(std::count_if(
        frames.begin(), frames.end(), [&](const auto& f) { return f.stamp.quality == quality; }));
  }
  // Frames of a quality are within this of the truth.
  nanoseconds worst(StampQuality quality) const {
    nanoseconds most{0};
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (frames[i].stamp.quality == quality) most = std::max(most, std::chrono::abs(error(i)));
    }
    return most;
  }
};

MatcherRun run_matcher(const MadeCamera& camera, const EdgeMatcherConfig& config) {
  EdgeMatcher matcher(config);
  MatcherRun run{.camera = &camera};
  for (const RigEvent& event : camera.events()) {
    if (const auto* edge = std::get_if<Edge>(&event)) {
      matcher.add(*edge);
    } else {
      matcher.add(std::get<std::shared_ptr<const CameraFrame>>(event), run.frames);
    }
  }
  matcher.finish(run.frames);
  run.state = matcher.state();
  return run;
}
MatcherRun run_matcher(const MadeCamera& camera) { return run_matcher(camera, matcher_config({})); }

TEST(EdgeMatcher, StampsEveryFrameWithItsOwnEdges) {
  MadeCamera camera;
  camera.shoot_many(600);
  const MatcherRun run = run_matcher(camera);
  EXPECT_EQ(run.count(StampQuality::kMeasured), 592U);  // all but the first eight
  double squares = 0.0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (!run.frames[i].synchronized()) continue;
    squares += std::pow(static_cast<double>(run.error(i).count()), 2);
  }
  EXPECT_LT(std::sqrt(squares / 592.0), 20'000.0);
  EXPECT_LT(run.worst(StampQuality::kMeasured), microseconds(60));  // four sigma of two edges
  EXPECT_EQ(run.state.associations, 1U);
  EXPECT_EQ(run.state.edges_matched, 592U);
  EXPECT_NEAR(static_cast<double>(run.state.period.count()), 33'333'000.0, 2'000.0);
}

TEST(EdgeMatcher, StampsMidExposureWhereOnlyTheTriggerIsSeen) {
  const MadeCameraOptions options{.exposure_active = false};
  MadeCamera camera(options);
  camera.shoot_many(300);
  const MatcherRun run = run_matcher(camera, matcher_config(options));
  EXPECT_EQ(run.count(StampQuality::kMeasured), 292U);
  EXPECT_LT(run.worst(StampQuality::kMeasured), microseconds(80));
}

TEST(EdgeMatcher, DoesNotClaimToHaveMeasuredAnExposureOfUnknownLength) {
  const MadeCameraOptions options{.exposure_active = false, .exposure = nanoseconds(0)};
  MadeCamera camera(options);
  camera.shoot_many(30);
  const MatcherRun run = run_matcher(camera, matcher_config(options));
  EXPECT_EQ(run.count(StampQuality::kEstimated), 22U);
  for (const StampedFrame& f : run.frames) EXPECT_GT(f.stamp.uncertainty, milliseconds(5));
}

TEST(EdgeMatcher, HoldsTheFirstFramesBackUntilTheyAgree) {
  MadeCamera camera;
  camera.shoot_many(7);
  const MatcherRun run = run_matcher(camera);
  EXPECT_EQ(run.frames.size(), 7U);
  EXPECT_EQ(run.count(StampQuality::kArrival), 7U);
  EXPECT_FALSE(run.state.locked);
}

// One fault after a good start: whatever it is, the frames that come are stamped rightly, and the
// ones after it are measured.
struct MatcherCase {
  const char* name;
  std::function<void(MadeCamera&)> fault;
  std::size_t estimated;  // exactly
  std::size_t unsynchronized_at_most;
};

class EdgeMatcherFault : public ::testing::TestWithParam<MatcherCase> {};

TEST_P(EdgeMatcherFault, LeavesNoFrameWithAWrongTime) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    MadeCamera camera({.seed = seed});
    camera.shoot_many(40);
    GetParam().fault(camera);
    camera.shoot_many(40);
    const MatcherRun run = run_matcher(camera);
    EXPECT_EQ(run.frames.size(), camera.frames());
    EXPECT_EQ(run.count(StampQuality::kEstimated), GetParam().estimated) << "seed " << seed;
    EXPECT_LE(run.count(StampQuality::kArrival), 8 + GetParam().unsynchronized_at_most)
        << "seed " << seed;
    EXPECT_LT(run.worst(StampQuality::kMeasured), microseconds(80)) << "seed " << seed;
    EXPECT_LT(run.worst(StampQuality::kEstimated), microseconds(300)) << "seed " << seed;
    EXPECT_TRUE(run.state.locked);
    EXPECT_EQ(run.frames.back().stamp.quality, StampQuality::kMeasured);
  }
}

const MatcherCase kMatcherCases[] = {
    {"LostRise", [](MadeCamera& c) { c.shoot({.lose_rise = true}); }, 1, 0},
    {"LostFall", [](MadeCamera& c) { c.shoot({.lose_fall = true}); }, 1, 0},
    {"LostEdges", [](MadeCamera& c) { c.shoot({.lose_rise = true, .lose_fall = true}); }, 1, 0},
    {"LostFrame", [](MadeCamera& c) { c.shoot({.lose_frame = true}); }, 0, 0},
    {"LostFrameAndEdges",
     [](MadeCamera& c) { c.shoot({.lose_rise = true, .lose_fall = true, .lose_frame = true}); }, 0,
     0},
    {"UncountedFrame", [](MadeCamera& c) { c.shoot({.ignore_trigger = true}); }, 0, 8},
    {"UncountedFrameAndLostEdges",
     [](MadeCamera& c) { c.shoot({.lose_rise = true, .lose_fall = true, .ignore_trigger = true}); },
     0, 8},
    {"BurstOfLostEdges",
     [](MadeCamera& c) { c.shoot_many(12, {.lose_rise = true, .lose_fall = true}); }, 12, 0},
    {"BurstOfLostFrames", [](MadeCamera& c) { c.shoot_many(12, {.lose_frame = true}); }, 0, 0},
    {"BurstOfBoth",
     [](MadeCamera& c) {
       c.shoot_many(12, {.lose_rise = true, .lose_fall = true, .lose_frame = true});
     },
     0, 0},
    {"RepeatedRise", [](MadeCamera& c) { c.shoot({.second_rise_at = milliseconds(1)}); }, 1, 0},
    {"GlitchAfterTheExposure", [](MadeCamera& c) { c.shoot({.glitch_at = milliseconds(7)}); }, 1,
     0},
    {"GlitchWithinTheExposure", [](MadeCamera& c) { c.shoot({.glitch_at = milliseconds(3)}); }, 1,
     0},
    {"GlitchAfterTheFrame", [](MadeCamera& c) { c.shoot({.glitch_at = milliseconds(24)}); }, 0, 0},
    {"LateFrame", [](MadeCamera& c) { c.shoot({.late = milliseconds(47)}); }, 0, 0},
    {"VeryLateFrame", [](MadeCamera& c) { c.shoot({.late = milliseconds(120)}); }, 0, 0},
    {"LateByAWholePeriod", [](MadeCamera& c) { c.shoot({.late = microseconds(33'333)}); }, 0, 0},
    {"RestartedCamera", [](MadeCamera& c) { c.restart(true); }, 0, 8},
    {"CountBeginsAnew", [](MadeCamera& c) { c.restart(false); }, 0, 8},
    {"LongPause", [](MadeCamera& c) { c.pause(seconds(7)); }, 0, 8},
    {"ShortPauseToANewPhase", [](MadeCamera& c) { c.pause(milliseconds(350)); }, 0, 10},
    {"PauseOfWholePeriods", [](MadeCamera& c) { c.pause(microseconds(5 * 33'333)); }, 0, 8},
    {"LongerExposure", [](MadeCamera& c) { c.set_exposure(milliseconds(9)); }, 0, 0},
};
INSTANTIATE_TEST_SUITE_P(Each, EdgeMatcherFault, ::testing::ValuesIn(kMatcherCases),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(EdgeMatcher, CountsWhatWentMissing) {
  MadeCamera camera;
  camera.shoot_many(40);
  camera.shoot_many(2, {.lose_rise = true, .lose_fall = true});
  camera.shoot_many(10);
  camera.shoot({.lose_rise = true});
  camera.shoot_many(10);
  camera.shoot_many(4, {.lose_frame = true});
  camera.shoot_many(2, {.late = milliseconds(60)});
  camera.shoot_many(10);
  const MatcherRun run = run_matcher(camera);
  EXPECT_EQ(run.state.edges_lost, 3U);
  EXPECT_EQ(run.state.frames_estimated, 3U);
  EXPECT_EQ(run.state.frames_lost, 4U);
  EXPECT_GE(run.state.frames_late, 2U);
  EXPECT_EQ(run.state.frames_unsynchronized, 8U);
}

TEST(EdgeMatcher, UncertaintyOfAPutInEdgeCoversItsError) {
  double squares = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    MadeCamera camera({.seed = seed});
    camera.shoot_many(40);
    camera.shoot_many(6, {.lose_rise = true, .lose_fall = true});
    camera.shoot_many(9);
    const MatcherRun run = run_matcher(camera);
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      if (run.frames[i].stamp.quality != StampQuality::kEstimated) continue;
      squares += std::pow(static_cast<double>(run.error(i).count()) /
                              static_cast<double>(run.frames[i].stamp.uncertainty.count()),
                          2);
      ++count;
    }
  }
  ASSERT_EQ(count, 240);
  EXPECT_LT(std::sqrt(squares / count), 1.2);
}

TEST(EdgeMatcher, StampsNothingWhileTheSensorIgnoresEverySecondTrigger) {
  const MadeCameraOptions options{.exposure_active = false, .exposure = milliseconds(40)};
  MadeCamera camera(options);
  for (int i = 0; i < 60; ++i) camera.shoot({.ignore_trigger = i % 2 == 1});
  const MatcherRun run = run_matcher(camera, matcher_config(options));
  EXPECT_EQ(run.count(StampQuality::kArrival), run.frames.size());
}

TEST(EdgeMatcher, StampsNothingWhenNoEdgeEverComes) {
  MadeCamera camera;
  camera.shoot_many(100, {.lose_rise = true, .lose_fall = true});
  const MatcherRun run = run_matcher(camera);
  EXPECT_EQ(run.count(StampQuality::kArrival), 100U);
  EXPECT_EQ(run.state.frames_unsynchronized, 100U);
}

TEST(EdgeMatcher, TakesTheArrivalWhereTheDriverStampsOnAnotherClock) {
  MadeCamera camera;
  camera.shoot_many(100);
  EdgeMatcher matcher(matcher_config({}));
  std::vector<StampedFrame> out;
  for (const RigEvent& event : camera.events()) {
    if (const auto* edge = std::get_if<Edge>(&event)) {
      matcher.add(*edge);
      continue;
    }
    auto frame =
        std::make_shared<CameraFrame>(*std::get<std::shared_ptr<const CameraFrame>>(event));
    frame->driver_time = HostTime(seconds(1'700'000'000));
    matcher.add(std::move(frame), out);
  }
  EXPECT_EQ(out.size(), 100U);
  EXPECT_EQ(matcher.state().edges_matched, 92U);
}

TEST(EdgeMatcher, FindsTheEdgeOfASlowCameraByItsLeastDelay) {
  MadeCameraOptions options{.readout = milliseconds(45)};
  MadeCamera camera(options);
  camera.shoot_many(60);
  EdgeMatcherConfig config = matcher_config(options);
  config.min_frame_delay = milliseconds(40);
  const MatcherRun run = run_matcher(camera, config);
  EXPECT_EQ(run.count(StampQuality::kMeasured), 52U);
  EXPECT_LT(run.worst(StampQuality::kMeasured), microseconds(80));
}

// Nothing that can happen gives a frame another exposure's time as measured.
RC_GTEST_PROP(EdgeMatcher, NeverMeasuresAWrongExposure, (bool exposure_active, unsigned seed)) {
  const MadeCameraOptions options{.exposure_active = exposure_active, .seed = seed};
  MadeCamera camera(options);
  camera.shoot_many(*rc::gen::inRange(0, 40));
  const int faults = *rc::gen::inRange(1, 12);
  bool paused = false;
  for (int i = 0; i < faults; ++i) {
    const int burst = *rc::gen::inRange(1, 5);
    switch (*rc::gen::inRange(0, 9)) {
      case 0:
      case 1:
        camera.shoot_many(burst * 4, {.lose_rise = *rc::gen::arbitrary<bool>(),
                                      .lose_fall = *rc::gen::arbitrary<bool>(),
                                      .lose_frame = *rc::gen::arbitrary<bool>()});
        break;
      case 2:
        camera.shoot_many(burst, {.lose_rise = *rc::gen::arbitrary<bool>(),
                                  .lose_fall = *rc::gen::arbitrary<bool>(),
                                  .ignore_trigger = true});
        break;
      case 3:
        camera.shoot_many(burst, {.late = microseconds(*rc::gen::inRange(1, 150'000))});
        break;
      case 4:
        camera.shoot_many(burst, {.glitch_at = microseconds(*rc::gen::inRange(6'000, 30'000))});
        break;
      case 5:
        camera.shoot_many(burst, {.second_rise_at = microseconds(*rc::gen::inRange(50, 30'000))});
        break;
      case 6:
        paused = true;
        camera.pause(microseconds(*rc::gen::inRange(1'000, 3'000'000)));
        break;
      case 7:
        camera.restart(*rc::gen::arbitrary<bool>());
        break;
      case 8:
        camera.set_exposure(microseconds(*rc::gen::inRange(100, 15'000)));
        break;
    }
    camera.shoot_many(*rc::gen::inRange(0, 25));
  }
  const MatcherRun run = run_matcher(camera, matcher_config(options));
  RC_ASSERT(run.frames.size() == camera.frames());
  HostTime last{};
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const Stamp& stamp = run.frames[i].stamp;
    if (!run.frames[i].synchronized()) continue;
    RC_ASSERT(stamp.mapped > last);
    last = stamp.mapped;
    if (stamp.quality == StampQuality::kMeasured) {
      RC_ASSERT(std::chrono::abs(run.error(i)) < microseconds(300));
    } else {
      RC_ASSERT(std::chrono::abs(run.error(i)) < options.period / 2);
      // A train that moves while its edges are lost cannot be known to have moved.
      RC_ASSERT(paused ||
                std::chrono::abs(run.error(i)) < 6 * stamp.uncertainty + microseconds(200));
    }
  }
}

}  // namespace
}  // namespace sparsight
