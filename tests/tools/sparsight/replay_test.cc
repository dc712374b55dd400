#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/build_paths.h"
#include "tools/evaluation/trajectory.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct ProgramRun {
  int exit_code;
  std::string output;  // of both streams
};

ProgramRun replay(const std::string& arguments) {
  const std::string command = testing::program().string() + " replay " + arguments + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return {WEXITSTATUS(::pclose(pipe)), output};
}

fs::path scratch(const char* name) {
  const fs::path path = fs::path(::testing::TempDir()) / name;
  fs::remove_all(path);
  return path;
}

TEST(Replay, UsageAndConfigurationErrorsExitWithTwo) {
  EXPECT_EQ(replay("").exit_code, 2);
  EXPECT_EQ(replay("somewhere --rays none").exit_code, 2);
  EXPECT_EQ(replay("somewhere --rays 0").exit_code, 2);
  const ProgramRun unknown = replay("somewhere --profile papre");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("papre"));
  const fs::path profile = scratch("replay_profile.toml");
  std::ofstream(profile) << "[window]\nsizes = 5\n";
  const ProgramRun key = replay("somewhere --profile " + profile.string());
  EXPECT_EQ(key.exit_code, 2);
  EXPECT_THAT(key.output, HasSubstr(profile.string() + ":2: [window] sizes: unknown key"));
}

TEST(Replay, SourceThatIsNotThereExitsWithOneAndLeavesNoFolder) {
  const fs::path output = scratch("replay_missing");
  const ProgramRun run = replay("/nonexistent/04 --output " + output.string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("/nonexistent/04"));
  EXPECT_FALSE(fs::exists(output));
}

class ReplayOfRecording : public ::testing::Test {
 protected:
  void SetUp() override {
    sequence_ = testing::recordings() / "kitti/odometry/sequences/04";
    if (!fs::exists(sequence_)) GTEST_SKIP() << sequence_ << " is not there; set SPARSIGHT_DATA";
  }

  fs::path sequence_;
};

TEST_F(ReplayOfRecording, WritesASessionAndReplacesItWhenRepeated) {
  const fs::path output = scratch("replay_session");
  const std::string arguments =
      sequence_.string() + " --max-frames 6 --rays 16 --output " + output.string();
  for (int time = 0; time < 2; ++time) {
    const ProgramRun run = replay(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(run.output, HasSubstr("results   " + output.string()));
    EXPECT_THAT(run.output, HasSubstr("ATE"));
  }
  const auto trajectory = read_trajectory(output / "trajectory.kitti");
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  EXPECT_EQ(trajectory->poses.size(), 6U);
  EXPECT_TRUE(trajectory->poses.front().isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  std::ifstream json(output / "session.json");
  const auto session = nlohmann::json::parse(json);
  EXPECT_EQ(session["complete"], true);
  EXPECT_EQ(session["rays"], 16);
  EXPECT_GT(session["map_points"], 1000);
}

TEST_F(ReplayOfRecording, QuietSaysNothingAndNoMapWritesNone) {
  const fs::path output = scratch("replay_quiet");
  const ProgramRun run =
      replay(sequence_.string() + " --max-frames 3 --quiet --no-map --output " + output.string());
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.output, "");
  EXPECT_FALSE(fs::exists(output / "map.ply"));
  EXPECT_TRUE(fs::exists(output / "report.html"));
}

TEST_F(ReplayOfRecording, DataSetFolderIsNeverWrittenInto) {
  const ProgramRun run =
      replay(sequence_.string() + " --max-frames 3 --output " + sequence_.string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("is not empty"));
}

TEST_F(ReplayOfRecording, UnreadableGroundTruthIsToldBeforeTheReplay) {
  const fs::path truth = scratch("replay_truth.txt");
  std::ofstream(truth) << "1 2 3\n";
  const fs::path output = scratch("replay_bad_truth");
  const ProgramRun run = replay(sequence_.string() + " --ground-truth " + truth.string() +
                                " --output " + output.string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr(truth.string()));
  EXPECT_FALSE(fs::exists(output));
}

}  // namespace
}  // namespace sparsight
