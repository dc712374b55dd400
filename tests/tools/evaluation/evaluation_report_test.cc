#include "tools/evaluation/evaluation_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const EvaluatedFiles kFiles{"est.txt", "truth.txt"};

Evaluation stretched(std::size_t frames) {
  return evaluate_trajectories(testing::straight_path(frames, 1.01), testing::straight_path(frames),
                               {})
      .value();
}

TEST(EvaluationReport, HasTheKeysMachinesRelyOn) {
  const auto json = nlohmann::json::parse(evaluation_json(stretched(301), kFiles));
  EXPECT_EQ(json.at("estimate"), "est.txt");
  EXPECT_EQ(json.at("ground_truth"), "truth.txt");
  EXPECT_EQ(json.at("frames"), 301);
  EXPECT_EQ(json.at("estimate_frames"), 301);
  EXPECT_EQ(json.at("ground_truth_frames"), 301);
  EXPECT_NEAR(json.at("path_length_m").get<double>(), 300.0, 1e-6);
  EXPECT_NEAR(json.at("kitti").at("t_rel_percent").get<double>(), 1.0, 1e-9);
  EXPECT_NEAR(json.at("kitti").at("r_rel_deg_per_m").get<double>(), 0.0, 1e-9);
  EXPECT_EQ(json.at("kitti").at("lengths").size(), 3U);
  EXPECT_EQ(json.at("kitti").at("lengths").at(1).at("length_m"), 200.0);
  EXPECT_EQ(json.at("kitti").at("lengths").at(1).at("segments"), 11);
  EXPECT_EQ(json.at("kitti").at("speeds").at(0).at("speed_m_per_s"), 10.0);
  for (const char* key : {"rmse_m", "mean_m", "median_m", "max_m"}) {
    EXPECT_TRUE(json.at("ate").at(key).is_number()) << key;
  }
  EXPECT_EQ(json.at("rpe").at("delta_frames"), 1);
  EXPECT_NEAR(json.at("rpe").at("translation_rmse_m").get<double>(), 0.01, 1e-9);
  EXPECT_NEAR(json.at("rpe").at("rotation_rmse_deg").get<double>(), 0.0, 1e-9);
}

TEST(EvaluationReport, GivesNullForWhatCouldNotBeComputed) {
  const auto json = nlohmann::json::parse(evaluation_json(stretched(1), kFiles));
  EXPECT_TRUE(json.at("kitti").at("t_rel_percent").is_null());
  EXPECT_TRUE(json.at("kitti").at("r_rel_deg_per_m").is_null());
  EXPECT_TRUE(json.at("rpe").at("translation_rmse_m").is_null());
  EXPECT_TRUE(json.at("ate").at("rmse_m").is_number());
  EXPECT_EQ(json.at("notes").size(), 1U);
}

TEST(EvaluationReport, TellsOfLoopsWhereTheyWereJudged) {
  Evaluation evaluation = stretched(51);
  EXPECT_TRUE(nlohmann::json::parse(evaluation_json(evaluation, kFiles)).at("loops").is_null());
  evaluation.loops = {.loops = {.loops = 40,
                                .false_loops = 1,
                                .max_error_m = 3.2,
                                .keyframes = 90,
                                .revisits = 30,
                                .closed = 27,
                                .submaps = 3,
                                .joined = 2,
                                .joined_falsely = 1},
                      .odometry_ate_m = 0.05,
                      .ate_m = 0.01};
  const auto json = nlohmann::json::parse(evaluation_json(evaluation, kFiles)).at("loops");
  EXPECT_EQ(json.at("standing"), 40);
  EXPECT_EQ(json.at("false"), 1);
  EXPECT_EQ(json.at("revisits_closed"), 27);
  EXPECT_EQ(json.at("submaps_joined_falsely"), 1);
  EXPECT_EQ(json.at("ate_rmse_m"), 0.01);
  const std::string table = evaluation_table(evaluation, kFiles);
  EXPECT_THAT(table, HasSubstr("40 stand, 1 of them false   largest error 3.2000 m"));
  EXPECT_THAT(table, HasSubstr("30 of 90 keyframes pass one again, 27 of them with a loop"));
  EXPECT_THAT(table, HasSubstr("3, 2 joined to an earlier one, 1 of them falsely"));
  EXPECT_THAT(table, HasSubstr("sub-maps of odometry 0.0500 m   what loops joined 0.0100"));
}

TEST(EvaluationReport, SurvivesFileNamesThatAreNotUtf8) {
  const auto json = nlohmann::json::parse(evaluation_json(stretched(2), {"\xff.txt", "t"}));
  EXPECT_THAT(json.at("estimate").get<std::string>(), HasSubstr(".txt"));
}

TEST(EvaluationReport, PutsWhatMustBeKnownBeforeTheFigures) {
  const std::string table = evaluation_table(stretched(51), kFiles);
  EXPECT_THAT(table, StartsWith("NOTE: the path is 50.0 m long: too short"));
  EXPECT_THAT(table, HasSubstr("KITTI error   none"));
}

TEST(EvaluationReport, ShowsTheFigures) {
  const std::string table = evaluation_table(stretched(301), kFiles);
  EXPECT_THAT(table, HasSubstr("t_rel 1.000 %"));
  EXPECT_THAT(table, HasSubstr("301 of 301 frames, 300.0 m"));
}

}  // namespace
}  // namespace sparsight
