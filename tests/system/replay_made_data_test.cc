#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/made_recording.h"
#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json session_of(const fs::path& folder) { return json::parse(text_of(folder / "session.json")); }

double ate_m(const fs::path& session) {
  return session_of(session).at("accuracy").at("ate_rmse_m").get<double>();
}

TEST(ReplayMadeData, AnOdometrySequenceGivesEveryFileAndStaysOnTheRoad) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_street(), 25, root / "data");
  const fs::path session = root / "session";
  const ProgramRun run = run_sparsight({"replay", sequence, "--output", session});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  for (const char* file :
       {"trajectory.kitti", "trajectory.tum", "map.ply", "session.json", "profile.toml"}) {
    EXPECT_TRUE(fs::exists(session / file)) << file;
  }
  EXPECT_EQ(pose_count(session / "trajectory.kitti"), 25U);
  EXPECT_EQ(pose_count(session / "trajectory.tum"), 25U);
  EXPECT_THAT(text_of(session / "trajectory.kitti"), ::testing::StartsWith("1"));
  EXPECT_EQ(session_of(session).at("predicted"), 0);
  EXPECT_LT(ate_m(session), 0.05);  // of 29 m; measured 0.02
}

TEST(ReplayMadeData, AHandHeldCorridorIsTracked) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_corridor(), 40, root / "data");
  const fs::path session = root / "session";
  const ProgramRun run = run_sparsight({"replay", sequence, "--output", session, "--no-map"});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(session_of(session).at("predicted"), 0);
  EXPECT_FALSE(fs::exists(session / "map.ply"));
  EXPECT_LT(ate_m(session), 0.05);  // of 4.3 m
}

TEST(ReplayMadeData, ARawDriveIsMovedToTheExposureFiringByFiring) {
  const fs::path root = scratch_folder();
  const fs::path drive = make_raw_drive(small_street(), 25, root / "data");
  const fs::path session = root / "session";
  ASSERT_EQ(run_sparsight({"replay", drive, "--output", session}).exit_code, 0);
  EXPECT_EQ(session_of(session).at("predicted"), 0);
  EXPECT_LT(ate_m(session), 0.06);
}

TEST(ReplayMadeData, ACarAtTheLightsStaysWhereItStandsWhileOthersFillTheImage) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_lights(), 100, root / "data");
  const fs::path session = root / "session";
  const ProgramRun run =
      run_sparsight({"replay", sequence, "--rays", "16", "--output", session, "--no-map"});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(session_of(session).at("predicted"), 0);
  EXPECT_THAT(text_of(session / "frames.csv"), ::testing::Not(::testing::HasSubstr("lost")));
  EXPECT_LT(ate_m(session), 0.15);  // it was 2 m before the LiDAR was asked
}

TEST(ReplayMadeData, TwoReplaysAreByteIdentical) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_street(), 15, root / "data");
  for (const char* session : {"first", "second"}) {
    ASSERT_EQ(run_sparsight({"replay", sequence, "--output", root / session}).exit_code, 0);
  }
  for (const char* file : {"trajectory.kitti", "trajectory.tum", "map.ply"}) {
    EXPECT_FALSE(text_of(root / "first" / file).empty()) << file;
    EXPECT_EQ(text_of(root / "first" / file), text_of(root / "second" / file)) << file;
  }
}

TEST(ReplayMadeData, FewerRaysAndFewerFramesAreWhatIsAskedFor) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_street(), 12, root / "data");
  const fs::path session = root / "session";
  const ProgramRun run =
      run_sparsight({"replay", sequence, "--rays", "8", "--max-frames", "10", "--output", session});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(session_of(session).at("rays"), 8);
  EXPECT_EQ(pose_count(session / "trajectory.kitti"), 10U);
  EXPECT_LT(ate_m(session), 0.05);
}

TEST(ReplayMadeData, PaperProfileCompletes) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_street(), 12, root / "data");
  const fs::path session = root / "session";
  const ProgramRun run =
      run_sparsight({"replay", sequence, "--profile", "paper", "--output", session});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_EQ(session_of(session).at("profile"), "paper");
  EXPECT_EQ(pose_count(session / "trajectory.kitti"), 12U);
}

}  // namespace
}  // namespace sparsight
