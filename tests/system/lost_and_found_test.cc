#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void simulate(std::vector<std::string> faults, const fs::path& recording) {
  // With images much smaller, few corners are left to know a place by.
  std::vector<std::string> words{"simulate", "--scene", "corridor", "--seed",
                                 "6",        "--size",  "400x300",  "--rate",
                                 "15",       "--quiet", "--output", recording};
  words.insert(words.end(), faults.begin(), faults.end());
  const ProgramRun made = run_sparsight(words);
  ASSERT_EQ(made.exit_code, 0) << made.errors;
}

double ate_m(const fs::path& session, const fs::path& truth) {
  const ProgramRun evaluation =
      run_sparsight({"evaluate", session / "trajectory.tum", "--ground-truth", truth, "--json"});
  EXPECT_EQ(evaluation.exit_code, 0) << evaluation.errors;
  return json::parse(evaluation.output).at("ate").at("rmse_m");
}

// In the dark the rig is carried back to a place it has seen before.
TEST(LostAndFound, AfterFiveSecondsInTheDarkAKnownPlaceIsFoundAndTheSubmapsAreJoined) {
  const fs::path folder = scratch_folder();
  simulate({"--duration", "20", "--cover", "8:5", "--carry", "9:-9"}, folder / "walk.mcap");
  const ProgramRun replay =
      run_sparsight({"replay", folder / "walk.mcap", "--output", folder / "session", "--no-map"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_NE(replay.errors.find("lost: where the camera is"), std::string::npos) << replay.errors;
  const json session = json::parse(text_of(folder / "session" / "session.json"));
  ASSERT_EQ(session.at("submaps").size(), 2) << session.at("submaps");
  EXPECT_EQ(session.at("submaps")[1].at("part"), session.at("submaps")[0].at("part"));
  ASSERT_EQ(session.at("gaps").size(), 1);
  EXPECT_NEAR(session.at("gaps")[0].at("seconds").get<double>(), 5.1, 0.3);
  const std::size_t lost = session.at("lost");
  EXPECT_GE(lost, 68U);
  EXPECT_LT(pose_count(folder / "session" / "trajectory.tum"),
            session.at("frames").get<std::size_t>() - lost)
      << "no pose for what was lost, nor for what had been predicted before";
  EXPECT_EQ(pose_count(folder / "session" / "trajectory.kitti"), session.at("frames"));
  EXPECT_LE(ate_m(folder / "session", folder / "walk.ground_truth.tum"), 0.05);
}

TEST(LostAndFound, LiveTheLossIsShownAndTheRecordingGoesOn) {
  const fs::path folder = scratch_folder();
  simulate({"--duration", "6", "--cover", "2:2"}, folder / "walk.mcap");
  const ProgramRun run = run_sparsight({"run", "--play", folder / "walk.mcap", "--output",
                                        folder / "session", "--no-map", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_NE(run.errors.find("lost: where the camera is"), std::string::npos) << run.errors;
  EXPECT_NE(run.output.find("\"state\":\"lost\""), std::string::npos) << run.output;
  const json session = json::parse(text_of(folder / "session" / "session.json"));
  EXPECT_GE(session.at("lost").get<int>(), 20);
  EXPECT_GE(session.at("tracked").get<int>(), 20 + 24) << "before it, and after";
  const ProgramRun recovery = run_sparsight({"recover", folder / "session" / "recording.mcap",
                                             "--output", folder / "copy.mcap", "--json"});
  EXPECT_EQ(json::parse(recovery.output).at("was_whole"), true) << recovery.errors;
}

TEST(LostAndFound, FaultsThatCannotBeReadAreRefused) {
  EXPECT_EQ(run_sparsight({"simulate", "--cover", "8", "--output", "x.mcap"}).exit_code, 2);
  EXPECT_EQ(run_sparsight({"simulate", "--carry", "-1:2", "--output", "x.mcap"}).exit_code, 2);
}

}  // namespace
}  // namespace sparsight
