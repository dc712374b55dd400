#include "slam/tracking/tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "slam/points/camera_returns.h"
#include "slam/points/point_selection.h"
#include "slam/points/visibility.h"
#include "tests/slam/sine_room.h"
#include "tests/slam/tracking/counted_budget.h"
#include "tests/synthetic/scene.h"

namespace sparsight {
namespace {

using Status = TrackingResult::Status;

class TrackerTest : public testing::Test {
 protected:
  TrackingResult track(const GreyImage& image, const TrackingStart& start,
                       const TrackerConfig& config = {.pyramid_levels = 3},
                       const PhotometryConfig& photometry = {}) const {
    return Tracker(room_.camera(), config, photometry)
        .track(keyframe_, ImagePyramid(image, config.pyramid_levels), start);
  }
  TrackingResult track_from(const Eigen::Isometry3d& T_true,
                            const Eigen::Isometry3d& T_predicted) const {
    return track(room_.image(T_true), {.T_keyframe_predicted = T_predicted, .error_px = 4.0});
  }
  void expect_near(const TrackingResult& result, const Eigen::Isometry3d& T_true) const {
    EXPECT_LT(turn_between(result.T_keyframe_camera, T_true), 3e-4);
    EXPECT_LT(shift_between(result.T_keyframe_camera, T_true), 2e-3);
  }

  const SineRoom room_{};
  const Keyframe keyframe_ = room_.keyframe(0, Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T_still_ = Eigen::Isometry3d::Identity();
};

TEST_F(TrackerTest, FindsThePoseAndSaysHowWell) {
  const Eigen::Isometry3d T_true = pose(0.01, 0.03, -0.01, 0.05, 0.02, 0.25);
  const TrackingResult result = track_from(T_true, T_still_);
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_TRUE(result.ok());
  expect_near(result, T_true);
  EXPECT_EQ(result.attempts, 1);
  EXPECT_GT(result.found_share, 0.95);
  EXPECT_LT(result.residual_sigma_grey, 1.0);
  EXPECT_GT(result.visible_ratio, 0.85);
  EXPECT_LT(result.visible_ratio, 1.0);
  EXPECT_NEAR(result.visible_ratio * static_cast<double>(keyframe_.points.size()),
              result.points_used, 1e-9);
  EXPECT_EQ(Eigen::LLT<Matrix6d>(result.information).info(), Eigen::Success);
}

TEST_F(TrackerTest, SaysWhenItRanOutOfIterations) {
  TrackerConfig hasty{.pyramid_levels = 3, .alignment = {.max_iterations = 1}};
  hasty.try_other_starts = false;
  const Eigen::Isometry3d T_true = pose(0.005, 0.01, 0.0, 0.02, 0.02, 0.05);
  EXPECT_EQ(track(room_.image(T_true), {}, hasty).status, Status::kIterationLimit);
}

TEST_F(TrackerTest, SaysWhenTooFewPointsAreInSight) {
  // Turned by 62 degrees, nearly the whole field of view.
  const Eigen::Isometry3d T_true = pose(0.0, 1.08, 0.0, 0.0, 0.0, 0.0);
  TrackerConfig config{.pyramid_levels = 3};
  config.try_other_starts = false;
  const TrackingResult result =
      track(room_.image(T_true), {.T_keyframe_predicted = T_true, .error_px = 1.0}, config);
  EXPECT_EQ(result.status, Status::kTooFewPoints);
  EXPECT_LT(result.points_used, 30);
}

TEST_F(TrackerTest, FindsASixDegreeTurnThatNobodyExpected) {
  for (const int axis : {0, 1, 2}) {
    for (const double sign : {-1.0, 1.0}) {
      Vector6d xi = 0.02 * Vector6d::Ones();
      xi(axis) += sign * 6.0 * M_PI / 180.0;
      const TrackingResult result = track(room_.image(exp_se3(xi)), {});
      EXPECT_TRUE(result.ok()) << axis;
      expect_near(result, exp_se3(xi));
    }
  }
}

TEST_F(TrackerTest, LooksElsewhereOnlyIfTheFirstStartFailsOrNoneIsKnown) {
  const GreyImage image = room_.image(T_still_);
  EXPECT_EQ(track(image, {.error_px = 1.0}).attempts, 1);
  EXPECT_EQ(track(image, {}).attempts, 1) << "nearly everything is found";
  SineRoom other = room_;
  other.pattern = 5;
  GreyImage half = image;  // the other half shows something else
  const GreyImage elsewhere = other.image(T_still_);
  std::copy_n(elsewhere.pixels.begin(), half.pixels.size() / 2, half.pixels.begin());
  EXPECT_GT(track(half, {}).attempts, 10) << "nothing is known of the motion";
  const TrackingStart wrong{.T_keyframe_predicted = pose(0.0, 1.3, 0.0, 0.0, 0.0, 0.0),
                            .error_px = 1.0};
  const TrackingResult recovered = track(image, wrong);
  EXPECT_TRUE(recovered.ok());
  EXPECT_GT(recovered.attempts, 1);
  expect_near(recovered, T_still_);
}

// Looks where nothing is to be seen, so that only a search finds the pose.
class TrackerBudget : public TrackerTest {
 protected:
  TrackingResult search(SearchBudget* budget) const {
    return track(room_.image(T_still_), {.T_keyframe_predicted = pose(0.0, 1.3, 0.0, 0.0, 0.0, 0.0),
                                         .error_px = 1.0,
                                         .search_budget = budget});
  }
  static void expect_same(const TrackingResult& a, const TrackingResult& b) {
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.T_keyframe_camera.matrix(), b.T_keyframe_camera.matrix());
    EXPECT_EQ(a.information, b.information);
    EXPECT_EQ(a.found_share, b.found_share);
    EXPECT_EQ(a.attempts, b.attempts);
  }
};

TEST_F(TrackerBudget, OfNothingLeavesWhatTheFirstStartFound) {
  CountedBudget nothing(0, 0);
  const TrackingResult result = search(&nothing);
  EXPECT_FALSE(result.ok());
  EXPECT_EQ(result.attempts, 1);
  EXPECT_EQ(nothing.asked(SearchBudget::Step::kFollow), 0) << "none was ranked";
}

TEST_F(TrackerBudget, OfOneIsSpentOnTheMostPromisingStart) {
  CountedBudget one(CountedBudget::kAny, 1);
  const TrackingResult result = search(&one);
  EXPECT_TRUE(result.ok());
  EXPECT_GT(result.attempts, 2) << "it is the best of some";
  expect_near(result, T_still_);
}

TEST_F(TrackerBudget, MayEndWhileStartsAreRanked) {
  CountedBudget few(5, CountedBudget::kAny);
  const TrackingResult result = search(&few);
  EXPECT_LE(result.attempts, 1 + 5);
  EXPECT_EQ(few.asked(SearchBudget::Step::kRank), 6) << "after a no it does not ask again";
}

TEST_F(TrackerBudget, ThatIsNeverUsedUpChangesNothing) {
  CountedBudget plenty(CountedBudget::kAny, CountedBudget::kAny);
  const TrackingResult result = search(&plenty);
  expect_same(result, search(nullptr));
  EXPECT_EQ(plenty.asked(SearchBudget::Step::kRank), 34);
  EXPECT_GE(plenty.asked(SearchBudget::Step::kFollow), 1);
}

TEST_F(TrackerBudget, IsNotAskedWhereThereIsNoNeedOfASearch) {
  CountedBudget nothing(0, 0);
  const TrackingResult result =
      track(room_.image(T_still_), {.error_px = 1.0, .search_budget = &nothing});
  EXPECT_TRUE(result.ok());
  EXPECT_EQ(nothing.asked(SearchBudget::Step::kRank), 0);
}

// Places with the texture of places; waves resemble each other too much.
TEST(TrackerElsewhere, ReportsNoPoseFromAnotherPlace) {
  const auto place = [](const char* name) {
    synthetic::Scene scene = *synthetic::make_scene(name);
    scene.resize(320, 240);
    return scene;
  };
  const synthetic::Scene here = place("hall");
  const CameraModel camera(here.rig.camera);
  const GreyImage image = here.image(0);
  Keyframe keyframe;
  keyframe.pyramid = ImagePyramid(image, 4);
  const std::vector<CameraReturn> returns = returns_in_image(
      here.sweep(0), camera, here.rig.T_camera_lidar, constant_motion(Vector6d::Zero()));
  keyframe.points = select_points(returns, hidden_from_camera(returns, camera), image, camera, {});
  keyframe.mean_inverse_depth = 0.2;
  for (int level = 0; level < 4; ++level) {
    keyframe.patches.push_back(make_patches(keyframe.pyramid, level, camera, keyframe.points, 0.0));
  }
  Tracker tracker(camera, {}, {});
  ASSERT_TRUE(tracker.track(keyframe, ImagePyramid(here.image(1), 4), {}).ok());
  for (const char* name : {"corridor", "street", "desk", "highway"}) {
    const ImagePyramid elsewhere(place(name).image(0), 4);
    const TrackingResult searched = tracker.track(keyframe, elsewhere, {});
    EXPECT_FALSE(searched.ok()) << name << ", found " << searched.found_share;
    EXPECT_FALSE(tracker.track(keyframe, elsewhere, {.error_px = 1.0}).ok()) << name;
  }
}

TEST_F(TrackerTest, ReportsNoPoseFromAnImageWithoutTexture) {
  for (const double grey : {0.0, 90.0, 255.0}) {
    const GreyImage blank = analytic_image(160, 120, [&](double, double) { return grey; });
    for (const bool affine : {false, true}) {
      const TrackingResult result =
          track(blank, {}, {.pyramid_levels = 3}, {.affine_brightness = affine});
      EXPECT_FALSE(result.ok()) << grey;
      EXPECT_TRUE(result.T_keyframe_camera.matrix().allFinite());
    }
  }
}

TEST_F(TrackerTest, ReportsNoPoseFromNoise) {
  SineRoom blank = room_;
  blank.contrast = 0.0;
  EXPECT_FALSE(track(blank.image(T_still_, {}, 30.0), {}).ok());
}

// A keyframe taken in the dark fits everything and tells nothing.
TEST_F(TrackerTest, ReportsNoPoseAgainstAKeyframeWithoutTexture) {
  const GreyImage black = analytic_image(160, 120, [](double, double) { return 0.0; });
  const Keyframe dark = room_.keyframe(0, T_still_, black);
  Tracker tracker(room_.camera(), {.pyramid_levels = 3}, {});
  for (const GreyImage& image : {black, room_.image(T_still_)}) {
    EXPECT_FALSE(tracker.track(dark, ImagePyramid(image, 3), {}).ok());
    EXPECT_FALSE(tracker.track(dark, ImagePyramid(image, 3), {.error_px = 1.0}).ok());
  }
}

TEST_F(TrackerTest, StartsAtTheFinestLevelThatSeesTheKeyframeIfTold) {
  TrackerConfig config{.pyramid_levels = 3};
  config.automatic_top_level = true;
  const GreyImage image = room_.image(T_still_);
  EXPECT_EQ(track(image, {.error_px = 3.0}, config).top_level, 0);
  EXPECT_EQ(track(image, {}, config).top_level, 2) << "nothing is known of the motion";
  EXPECT_EQ(track(image, {.error_px = 3.0}).top_level, 2) << "not told";
}

TEST_F(TrackerTest, WorksWithAsManyLevelsAsTheImageHas) {
  const Eigen::Isometry3d T_true = pose(0.0, 0.005, 0.0, 0.01, 0.0, 0.05);
  const TrackingResult result = Tracker(room_.camera(), {.pyramid_levels = 6}, {})
                                    .track(keyframe_, ImagePyramid(room_.image(T_true), 1), {});
  EXPECT_TRUE(result.ok());
  expect_near(result, T_true);
}

TEST_F(TrackerTest, GivesTheSameResultEveryTime) {
  const GreyImage image = room_.image(pose(0.02, 0.05, 0.0, 0.1, 0.0, 0.1), {}, 3.0);
  const TrackingResult a = track(image, {});
  const TrackingResult b = track(image, {});
  EXPECT_EQ(a.T_keyframe_camera.matrix(), b.T_keyframe_camera.matrix());
  EXPECT_EQ(a.information, b.information);
}

}  // namespace
}  // namespace sparsight
