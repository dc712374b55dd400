#include "tools/evaluation/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "tests/build_paths.h"
#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

using std::chrono::milliseconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Evaluation evaluated(const Trajectory& estimate, const Trajectory& truth,
                     const EvaluationOptions& options = {}) {
  auto evaluation = evaluate_trajectories(estimate, truth, options);
  if (!evaluation) {
    throw std::runtime_error(evaluation.error().message);
  }
  return *std::move(evaluation);
}

TEST(Evaluation, OfARigidlyMovedCopyIsZero) {
  const Trajectory truth = testing::winding_path(500);
  const Eigen::Isometry3d T = testing::pose({0.3, -1.2, 0.5}, {100, -20, 3});
  const Evaluation evaluation = evaluated(testing::moved(T, truth), truth);
  EXPECT_NEAR(evaluation.ate.rmse_m, 0.0, 1e-10);
  EXPECT_NEAR(evaluation.ate.max_m, 0.0, 1e-10);
  EXPECT_NEAR(evaluation.kitti.t_rel_percent.value(), 0.0, 1e-10);
  EXPECT_NEAR(evaluation.kitti.r_rel_deg_per_m.value(), 0.0, 1e-10);
  EXPECT_NEAR(evaluation.rpe.value().translation_rmse_m, 0.0, 1e-10);
  EXPECT_NEAR(evaluation.rpe.value().rotation_rmse_deg, 0.0, 1e-10);
  EXPECT_TRUE(evaluation.ate.T_truth_estimate.isApprox(T.inverse(), 1e-10));
  EXPECT_THAT(evaluation.notes, IsEmpty());
}

// Points at 0, 1, 2, 3, 4 m stretched by s about their middle: distances (s-1) * {2, 1, 0, 1, 2}.
TEST(Evaluation, OfAStretchedStraightRoadHasTheAnalyticAbsoluteError) {
  const Evaluation evaluation =
      evaluated(testing::straight_path(5, 1.5), testing::straight_path(5));
  EXPECT_NEAR(evaluation.ate.rmse_m, 0.5 * std::sqrt(10.0 / 5.0), 1e-9);
  EXPECT_NEAR(evaluation.ate.mean_m, 0.5 * 6.0 / 5.0, 1e-9);
  EXPECT_NEAR(evaluation.ate.median_m, 0.5, 1e-9);
  EXPECT_NEAR(evaluation.ate.max_m, 1.0, 1e-9);
  EXPECT_NEAR(evaluation.path_length_m, 4.0, 1e-9);
  EXPECT_NEAR(evaluation.rpe.value().translation_rmse_m, 0.5, 1e-9);
}

TEST(Evaluation, TakesTheMeanOfTheMiddleTwoAsMedian) {
  // Four points: distances 0.5 * {1.5, 0.5, 0.5, 1.5}.
  const Evaluation evaluation =
      evaluated(testing::straight_path(4, 1.5), testing::straight_path(4));
  EXPECT_NEAR(evaluation.ate.median_m, 0.5, 1e-9);
}

TEST(Evaluation, GivesRelativeErrorOverAsManyFramesAsAsked) {
  const Trajectory truth = testing::straight_path(50);
  Trajectory estimate;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 50; ++i) {
    estimate.poses.push_back(T);
    T = T * testing::pose({0, 0, 0.01}, {0, 0, testing::kStep_m});  // rolls about its path
  }
  const Evaluation evaluation = evaluated(estimate, truth, {.rpe_delta_frames = 5});
  EXPECT_NEAR(evaluation.rpe.value().rotation_rmse_deg, 5 * 0.01 * 180.0 / M_PI, 1e-9);
  EXPECT_NEAR(evaluation.rpe.value().translation_rmse_m, 0.0, 1e-9);
  EXPECT_FALSE(evaluated(estimate, truth, {.rpe_delta_frames = 50}).rpe.has_value());
}

TEST(Evaluation, OfTooShortAPathSaysSoAndGivesTheRest) {
  const Evaluation evaluation =
      evaluated(testing::straight_path(51, 1.01), testing::straight_path(51));
  EXPECT_FALSE(evaluation.kitti.t_rel_percent.has_value());
  EXPECT_GT(evaluation.ate.rmse_m, 0.1);
  EXPECT_THAT(evaluation.notes, ElementsAre(HasSubstr("the path is 50.0 m long: too short")));
}

TEST(Evaluation, OfASinglePoseHasNoErrorToReport) {
  const Evaluation evaluation = evaluated(testing::straight_path(1), testing::straight_path(1));
  EXPECT_EQ(evaluation.frames, 1U);
  EXPECT_EQ(evaluation.ate.rmse_m, 0.0);
  EXPECT_FALSE(evaluation.rpe.has_value());
}

TEST(Evaluation, OfAnEstimateThatStoppedEarlyCoversWhatThereIs) {
  const Evaluation evaluation = evaluated(testing::straight_path(150), testing::straight_path(400));
  EXPECT_EQ(evaluation.frames, 150U);
  EXPECT_EQ(evaluation.truth_frames, 400U);
  EXPECT_NEAR(evaluation.path_length_m, 149.0, 1e-6);
  EXPECT_THAT(evaluation.notes, ElementsAre(HasSubstr("only the first 150 are evaluated")));
}

TEST(Evaluation, AsksWhetherAShorterGroundTruthIsTheRightOne) {
  const Evaluation evaluation = evaluated(testing::straight_path(400), testing::straight_path(150));
  EXPECT_EQ(evaluation.frames, 150U);
  EXPECT_THAT(evaluation.notes, ElementsAre(HasSubstr("is it the ground truth of this sequence")));
}

TEST(Evaluation, PairsByTimeWhereTheGroundTruthIsDenser) {
  const Trajectory truth = testing::timed(testing::straight_path(401), milliseconds(10));
  Trajectory estimate{.source = "every fourth"};
  for (std::size_t i = 0; i < truth.poses.size(); i += 4) {
    estimate.poses.push_back(truth.poses[i]);
    estimate.times.push_back(truth.times[i] + milliseconds(3));
  }
  const Evaluation evaluation = evaluated(estimate, truth);
  EXPECT_EQ(evaluation.frames, 101U);
  EXPECT_NEAR(evaluation.ate.rmse_m, 0.0, 1e-9);
  EXPECT_THAT(evaluation.notes, IsEmpty());
}

TEST(Evaluation, SaysHowManyPosesHaveNoGroundTruthAtTheirTime) {
  const Trajectory truth = testing::timed(testing::straight_path(300), milliseconds(100));
  const Trajectory estimate =
      testing::timed(testing::straight_path(301), milliseconds(100), milliseconds(1000));
  const Evaluation evaluation = evaluated(estimate, truth);
  EXPECT_EQ(evaluation.frames, 290U);
  EXPECT_EQ(evaluation.estimate_indices.back(), 289U);
  EXPECT_THAT(evaluation.notes, ElementsAre(HasSubstr("only 290 of the estimate's 301 poses")));
}

TEST(Evaluation, HandsOutTheEstimateInTheGroundTruthsWorld) {
  const Trajectory truth = testing::winding_path(50);
  const Evaluation evaluation =
      evaluated(testing::moved(testing::pose({1, 2, 3}, {4, 5, 6}), truth), truth);
  ASSERT_EQ(evaluation.aligned_positions.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_LT((evaluation.aligned_positions[i] - truth.poses[i].translation()).norm(), 1e-10);
    EXPECT_EQ(evaluation.truth_positions[i], truth.poses[i].translation());
  }
}

RC_GTEST_PROP(Evaluation, DoesNotDependOnWhereEitherPathStarts, ()) {
  const Trajectory truth = testing::arbitrary_path(30);
  const Trajectory estimate = testing::arbitrary_path(30);
  const EvaluationOptions options{.segments = {.lengths_m = {5, 10}, .step_frames = 2}};
  const Evaluation still = evaluated(estimate, truth, options);
  const Evaluation shifted =
      evaluated(testing::moved(testing::arbitrary_pose(100.0), estimate),
                testing::moved(testing::arbitrary_pose(100.0), truth), options);
  RC_ASSERT(std::abs(still.ate.rmse_m - shifted.ate.rmse_m) < 1e-9);
  RC_ASSERT(std::abs(still.ate.max_m - shifted.ate.max_m) < 1e-7);
  RC_ASSERT(std::abs(still.rpe->translation_rmse_m - shifted.rpe->translation_rmse_m) < 1e-9);
  RC_ASSERT(std::abs(still.rpe->rotation_rmse_deg - shifted.rpe->rotation_rmse_deg) < 1e-8);
}

// The official ground truth of the KITTI odometry sequences.
class OfficialPoses : public ::testing::TestWithParam<std::string> {
 protected:
  Trajectory truth() const {
    const auto file = testing::recordings() / "kitti/odometry/poses" / (GetParam() + ".txt");
    if (!std::filesystem::exists(file)) {
      return {};
    }
    return read_trajectory(file).value();
  }
};

TEST_P(OfficialPoses, HaveNoErrorAgainstThemselves) {
  const Trajectory path = truth();
  if (path.poses.empty()) {
    GTEST_SKIP() << "no KITTI poses in " << testing::recordings();
  }
  const Evaluation evaluation = evaluated(path, path);
  EXPECT_NEAR(evaluation.kitti.t_rel_percent.value(), 0.0, 1e-9);
  EXPECT_NEAR(evaluation.kitti.r_rel_deg_per_m.value(), 0.0, 1e-9);
  EXPECT_NEAR(evaluation.ate.rmse_m, 0.0, 1e-9);
  EXPECT_NEAR(evaluation.rpe.value().translation_rmse_m, 0.0, 1e-9);
}

// Independent position noise of sigma per axis: each segment's error is the difference of two
// draws, of which the mean length is 2 sigma sqrt(4/pi); ATE is sigma sqrt(3).
TEST_P(OfficialPoses, WithNoiseHaveTheErrorOfTheNoise) {
  const Trajectory path = truth();
  if (path.poses.empty()) {
    GTEST_SKIP() << "no KITTI poses in " << testing::recordings();
  }
  constexpr double kSigma = 0.1;
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, kSigma);
  Trajectory noised = path;
  for (Eigen::Isometry3d& pose : noised.poses) {
    const double x = noise(random);
    const double y = noise(random);
    pose.translation() += Eigen::Vector3d(x, y, noise(random));
  }
  const Evaluation evaluation =
      evaluated(noised, path, {.segments = {.lengths_m = {100.0}, .step_frames = 1}});
  const double expected_percent = 2.0 * kSigma * std::sqrt(4.0 / M_PI);
  EXPECT_NEAR(evaluation.kitti.t_rel_percent.value(), expected_percent, 0.1 * expected_percent);
  EXPECT_NEAR(evaluation.ate.rmse_m, kSigma * std::sqrt(3.0), 0.1 * kSigma * std::sqrt(3.0));
}

INSTANTIATE_TEST_SUITE_P(Kitti, OfficialPoses,
                         ::testing::Values("00", "01", "02", "03", "04", "05", "06", "07", "08",
                                           "09", "10"),
                         [](const auto& instance) { return instance.param; });

// What a second, independent transcription of the development kit (matrix inverses, arc cosine)
// gives for positions stretched by 1 % and a yaw that drifts 1e-5 rad a frame.
struct Reference {
  std::string sequence;
  SegmentOptions options;
  std::size_t segments;
  double t_rel_percent;
  double r_rel_deg_per_m;
};

TEST(Evaluation, AgreesWithAnIndependentTranscriptionOfTheDevelopmentKit) {
  const std::vector<Reference> references = {
      {"00", {}, 3283, 1.507359843, 0.000707953},
      {"07", {}, 317, 0.675182054, 0.000845395},
      {"04", {{10, 20, 30, 40, 50}, 1}, 1259, 1.049089355, 0.000409773}};
  for (const Reference& reference : references) {
    const auto file =
        testing::recordings() / "kitti/odometry/poses" / (reference.sequence + ".txt");
    if (!std::filesystem::exists(file)) {
      GTEST_SKIP() << "no KITTI poses in " << testing::recordings();
    }
    const Trajectory truth = read_trajectory(file).value();
    Trajectory estimate = truth;
    for (std::size_t i = 0; i < truth.poses.size(); ++i) {
      const Eigen::Isometry3d turn =
          testing::pose({0, 1e-5 * static_cast<double>(i), 0}, Eigen::Vector3d::Zero());
      estimate.poses[i].linear() = turn.linear() * truth.poses[i].linear();
      estimate.poses[i].translation() *= 1.01;
    }
    const Evaluation evaluation = evaluated(estimate, truth, {.segments = reference.options});
    EXPECT_EQ(evaluation.kitti.segments.size(), reference.segments);
    EXPECT_NEAR(evaluation.kitti.t_rel_percent.value(), reference.t_rel_percent, 1e-5);
    EXPECT_NEAR(evaluation.kitti.r_rel_deg_per_m.value(), reference.r_rel_deg_per_m, 1e-7);
  }
}

}  // namespace
}  // namespace sparsight
