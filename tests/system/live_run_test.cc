#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/build_paths.h"
#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;

// A walk of some seconds, made once for all tests of this file.
const fs::path& recorded_walk() {
  static const fs::path recording = [] {
    const fs::path folder = fs::path(::testing::TempDir()) / "sparsight_live_walk";
    fs::create_directories(folder);
    const fs::path file = folder / (std::to_string(getpid()) + ".mcap");
    const ProgramRun made = run_sparsight({"simulate", "--duration", "3", "--seed", "3", "--size",
                                           "320x240", "--output", file, "--quiet"});
    EXPECT_EQ(made.exit_code, 0) << made.errors;
    return file;
  }();
  return recording;
}

// `sparsight run` in the background, for tests that end it.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& arguments) : pid_(fork()) {
    if (pid_ != 0) return;
    std::vector<std::string> words{testing::program()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execv(argv.front(), argv.data());
    _exit(127);
  }
  // The status as of waitpid.
  int end_by(int signal) const {
    kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    return status;
  }

 private:
  pid_t pid_;
};

bool wait_for_poses(const fs::path& file, std::size_t poses) {
  for (int i = 0; i < 200; ++i) {
    if (pose_count(file) >= poses) return true;
    std::this_thread::sleep_for(50ms);
  }
  return false;
}

std::vector<std::array<double, 3>> positions(const fs::path& file) {
  std::vector<std::array<double, 3>> result;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) {
    double time = 0.0;
    std::array<double, 3> p{};
    if (line.starts_with("#")) continue;
    std::istringstream(line) >> time >> p[0] >> p[1] >> p[2];
    result.push_back(p);
  }
  return result;
}

TEST(LiveRun, TracksAndRecordsAPlayedWalkAsItsReplayDoes) {
  const fs::path folder = scratch_folder();
  const ProgramRun live = run_sparsight(
      {"run", "--play", recorded_walk(), "--output", folder / "live", "--no-map", "--json"});
  ASSERT_EQ(live.exit_code, 0) << live.errors;
  const ProgramRun replay = run_sparsight(
      {"replay", recorded_walk(), "--output", folder / "replay", "--no-map", "--quiet"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;

  const auto tracked = positions(folder / "live" / "trajectory.tum");
  const auto replayed = positions(folder / "replay" / "trajectory.tum");
  ASSERT_EQ(tracked.size(), replayed.size());
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(tracked[i][axis], replayed[i][axis], 0.01) << "frame " << i;
    }
  }
  const json session = json::parse(text_of(folder / "live" / "session.json"));
  EXPECT_EQ(session.at("complete"), true);
  EXPECT_EQ(session.at("predicted"), 0);
  EXPECT_EQ(session.at("live").at("frames_dropped"), 0);
  EXPECT_EQ(session.at("live").at("events_unrecorded"), 0);
  EXPECT_LE(session.at("live").at("first_pose_s").get<double>(), 2.0);
  EXPECT_EQ(session.at("loop_search").at("keyframes"), session.at("keyframes"));
  EXPECT_TRUE(fs::exists(folder / "live" / "odometry.tum"));
  const json state = json::parse(live.output.substr(0, live.output.find('\n')));
  EXPECT_EQ(state.at("camera").at("state"), "streaming");

  // What it recorded is what was played: it replays to the same path.
  const ProgramRun again = run_sparsight({"replay", folder / "live" / "recording.mcap", "--output",
                                          folder / "again", "--no-map", "--quiet"});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(text_of(folder / "again" / "trajectory.kitti"),
            text_of(folder / "replay" / "trajectory.kitti"));
}

TEST(LiveRun, EndsWholeWhenItIsAskedTo) {
  const fs::path folder = scratch_folder() / "session";
  const RunningProgram program(
      {"run", "--play", recorded_walk(), "--output", folder, "--no-map", "--quiet"});
  ASSERT_TRUE(wait_for_poses(folder / "trajectory.tum", 30));
  const int status = program.end_by(SIGTERM);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const json session = json::parse(text_of(folder / "session.json"));
  EXPECT_EQ(session.at("complete"), true);
  EXPECT_EQ(session.at("frames"), pose_count(folder / "trajectory.tum"));
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  const ProgramRun recovery = run_sparsight(
      {"recover", folder / "recording.mcap", "--output", folder / "copy.mcap", "--json"});
  EXPECT_EQ(json::parse(recovery.output).at("was_whole"), true) << recovery.errors;
}

TEST(LiveRun, LeavesAllButTheLastSecondWhenItIsKilled) {
  const fs::path folder = scratch_folder() / "session";
  const RunningProgram program(
      {"run", "--play", recorded_walk(), "--output", folder, "--no-map", "--quiet"});
  ASSERT_TRUE(wait_for_poses(folder / "trajectory.tum", 65));
  program.end_by(SIGKILL);
  const std::size_t tracked = pose_count(folder / "trajectory.tum");
  EXPECT_GE(tracked, 65U);
  EXPECT_GE(pose_count(folder / "frames.csv"), tracked) << "a row for each, and the heading";
  EXPECT_EQ(json::parse(text_of(folder / "session.json")).at("complete"), false);
  const ProgramRun replay = run_sparsight({"replay", folder / "recording.mcap", "--output",
                                           folder / "replayed", "--no-map", "--quiet"});
  ASSERT_EQ(replay.exit_code, 0) << replay.errors;
  EXPECT_GE(pose_count(folder / "replayed" / "trajectory.tum") + 30, tracked);
}

TEST(LiveRun, RecordsWithoutTracking) {
  const fs::path folder = scratch_folder() / "session";
  const ProgramRun record = run_sparsight(
      {"record", "--play", recorded_walk(), "--output", folder, "--seconds", "1.5", "--quiet"});
  ASSERT_EQ(record.exit_code, 0) << record.errors;
  const ProgramRun replay = run_sparsight({"replay", folder / "recording.mcap", "--output",
                                           folder / "replayed", "--no-map", "--quiet"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  const ProgramRun twice =
      run_sparsight({"record", "--play", recorded_walk(), "--output", folder, "--quiet"});
  EXPECT_EQ(twice.exit_code, 1);
  EXPECT_NE(twice.errors.find("holds a recording"), std::string::npos) << twice.errors;
}

TEST(LiveRun, GoesOnThoughNoDeviceIsThereAndSaysSo) {
  const fs::path folder = scratch_folder() / "session";
  const ProgramRun run =
      run_sparsight({"run", "--rig", testing::source_dir() / "config/rig/handheld.toml", "--output",
                     folder, "--seconds", "0.6", "--no-map"});
  EXPECT_EQ(run.exit_code, 1) << "nothing was tracked";
  EXPECT_NE(run.errors.find("camera is gone"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("/dev/video0"), std::string::npos) << run.errors;
  EXPECT_TRUE(fs::exists(folder / "recording.mcap"));
}

TEST(LiveRun, ShowsASensorThatGoesAndComesBackAndTracksOn) {
  const fs::path folder = scratch_folder();
  const fs::path recording = folder / "away.mcap";
  const ProgramRun made =
      run_sparsight({"simulate", "--duration", "3.5", "--seed", "3", "--size", "160x120", "--away",
                     "camera:1.5:0.7", "--output", recording, "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.errors;
  const ProgramRun run =
      run_sparsight({"run", "--play", recording, "--output", folder / "session", "--no-map"});
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  const std::size_t gone = run.errors.find("camera is gone");
  ASSERT_NE(gone, std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("camera is streaming", gone), std::string::npos) << run.errors;
  const json session = json::parse(text_of(folder / "session" / "session.json"));
  EXPECT_EQ(session.at("complete"), true);
  EXPECT_GE(session.at("tracked").get<int>(), 36 + 24) << "before it went, and after";
}

TEST(LiveRun, NeedsToBeToldOnWhat) {
  EXPECT_EQ(run_sparsight({"run"}).exit_code, 2);
  EXPECT_EQ(run_sparsight({"run", "--rig", "/nowhere.toml"}).exit_code, 1);
}

}  // namespace
}  // namespace sparsight
