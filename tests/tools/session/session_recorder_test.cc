#include "tools/session/session_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/session/sample_session.h"
#include "tools/configuration/profile.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t lines_of(const fs::path& path) {
  const std::string text = text_of(path);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

class RecordedSession : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  static constexpr std::uint64_t kFrames = 250;

  void record(SessionRecorder& recorder) {
    ASSERT_TRUE(recorder.begin());
    std::vector<TrajectoryPose> trajectory;
    for (std::uint64_t i = 0; i < kFrames; ++i) {
      const FrameRecord frame = sample_record(i);
      recorder.add(frame);
      trajectory.push_back({i, frame.exposure, frame.outcome.T_world_camera});
      if (!frame.outcome.becomes_keyframe) continue;
      recorder.add({.sequence = i,
                    .T_world_camera = frame.outcome.T_world_camera,
                    .cloud_camera = {{.p_camera = {0, 0, 5}, .rgb = {1, 2, 3}}}});
    }
    recorder.end({.odometry = std::move(trajectory)}, std::chrono::seconds(5));
  }

  static SessionDescription without_loops(SessionDescription description = {}) {
    description.config.loop.enabled = false;
    return description;
  }

  nlohmann::json json() const { return nlohmann::json::parse(text_of(folder_ / "session.json")); }

  fs::path folder_;
};

TEST_F(RecordedSession, LeavesEveryFileWholeAndNothingElse) {
  SessionRecorder recorder(folder_, without_loops(sample_session(1).description),
                           {CloudFormat::kPly});
  record(recorder);
  ASSERT_TRUE(recorder.write());
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    names.push_back(entry.path().filename());
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("trajectory.kitti", "trajectory.tum",
                                                     "frames.csv", "map.ply", "report.html",
                                                     "profile.toml", "session.json"));
}

TEST_F(RecordedSession, TrajectoriesHaveOnePosePerFrame) {
  SessionRecorder recorder(folder_, without_loops(), {CloudFormat::kPly});
  record(recorder);
  ASSERT_TRUE(recorder.write());
  const auto kitti = read_trajectory(folder_ / "trajectory.kitti");
  ASSERT_TRUE(kitti) << kitti.error().message;
  ASSERT_EQ(kitti->poses.size(), kFrames);
  EXPECT_TRUE(kitti->poses.front().isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  EXPECT_TRUE(kitti->poses.back().isApprox(sample_pose(0.1 * (kFrames - 1)), 1e-12));
  const auto tum = read_trajectory(folder_ / "trajectory.tum");
  ASSERT_TRUE(tum) << tum.error().message;
  ASSERT_EQ(tum->times.size(), kFrames);
  EXPECT_EQ(tum->times.back(), sample_record(kFrames - 1).exposure);
}

TEST_F(RecordedSession, JsonCountsWhatHappened) {
  SessionDescription description = without_loops(sample_session(1).description);
  description.rays = 16;
  SessionRecorder recorder(folder_, description, {CloudFormat::kPly});
  record(recorder);
  ASSERT_TRUE(recorder.write());
  const nlohmann::json session = json();
  EXPECT_EQ(session["complete"], true);
  EXPECT_EQ(session["profile"], "default");
  EXPECT_EQ(session["rays"], 16);
  EXPECT_EQ(session["frames"], kFrames);
  EXPECT_EQ(session["tracked"], kFrames - 1);
  EXPECT_EQ(session["predicted"], 1);
  EXPECT_EQ(session["keyframes"], 32);
  EXPECT_EQ(session["map_points"], 32);
  EXPECT_EQ(session["faults"]["malformed"], 1);
  EXPECT_DOUBLE_EQ(session["frames_per_s"], kFrames / 5.0);
  EXPECT_DOUBLE_EQ(session["times_real_time"], 24.9 / 5.0);
  EXPECT_DOUBLE_EQ(session["tracking_ms"]["max"], 0.9 + 0.037 * 22);
  EXPECT_EQ(session["window_ms"]["calls"], 32);
  EXPECT_TRUE(session["accuracy"].is_null());
}

TEST_F(RecordedSession, JournalHasALinePerFrameAndSurvivesACrash) {
  {
    SessionRecorder recorder(folder_, without_loops(), {CloudFormat::kPly});
    record(recorder);
    EXPECT_EQ(lines_of(folder_ / "frames.csv.partial"), kFrames + 1);
  }  // as after a crash: write() was never reached
  EXPECT_EQ(lines_of(folder_ / "frames.csv.partial"), kFrames + 1);
  EXPECT_EQ(json()["complete"], false);
  EXPECT_FALSE(fs::exists(folder_ / "trajectory.kitti"));
}

TEST_F(RecordedSession, JournalLineHoldsTheFramesFigures) {
  EXPECT_EQ(frames_csv_line(figures_of(sample_record(210))),
            "210,21.000000000,predicted,829,7.7264,0.9750,0.0000,4,0,1.0110,0.0000\n");
}

TEST_F(RecordedSession, LoopsLeaveBothPathsAndTheMapOfTheCorrectedOne) {
  SessionDescription description;
  description.config.loop.enabled = true;
  SessionRecorder recorder(folder_, description, {CloudFormat::kPly});
  ASSERT_TRUE(recorder.begin());
  const FrameRecord frame = sample_record(0);
  recorder.add(frame);
  recorder.add({.sequence = 0, .cloud_camera = {{.p_camera = {0, 0, 5}, .rgb = {1, 2, 3}}}});
  const std::size_t stored =
      recorder.keyframes()->put({.cloud_camera = {{.p_camera = {0, 0, 5}, .rgb = {1, 2, 3}}}});
  Eigen::Isometry3d corrected = Eigen::Isometry3d::Identity();
  corrected.translation().x() = 40.0;
  recorder.session().loops.push_back({.candidate = 0, .current = 0});
  recorder.end({.odometry = {{0, frame.exposure, Eigen::Isometry3d::Identity()}},
                .corrected = {{0, frame.exposure, corrected}},
                .placed = {{.stored = stored, .T_world_camera = corrected}}},
               std::chrono::seconds(1));
  ASSERT_TRUE(recorder.write());
  EXPECT_EQ(read_trajectory(folder_ / "trajectory.tum").value().poses[0].translation().x(), 40.0);
  EXPECT_EQ(read_trajectory(folder_ / "odometry.tum").value().poses[0].translation().x(), 0.0);
  EXPECT_FALSE(fs::exists(folder_ / "keyframes.partial"));
  EXPECT_EQ(json()["loops"].size(), 1);
  EXPECT_THAT(text_of(folder_ / "report.html"), ::testing::HasSubstr("odometry, without loops"));
  EXPECT_THAT(text_of(folder_ / "map.ply"), ::testing::HasSubstr("element vertex 1\n"));
  float x = 0.0F;  // the only vertex begins behind the header
  const std::string map = text_of(folder_ / "map.ply");
  std::memcpy(&x, map.data() + map.find("end_header\n") + 11, sizeof(x));
  EXPECT_FLOAT_EQ(x, 40.0F);
  // A session without loops in the same folder leaves only its own.
  SessionRecorder again(folder_, without_loops(), {});
  again.add(frame);
  again.end({}, std::chrono::seconds(1));
  ASSERT_TRUE(again.write());
  EXPECT_FALSE(fs::exists(folder_ / "odometry.tum"));
}

TEST_F(RecordedSession, EarlierSessionStaysUntilTheNewOneIsWritten) {
  {
    SessionRecorder recorder(folder_, without_loops(), {CloudFormat::kPly});
    record(recorder);
    ASSERT_TRUE(recorder.write());
  }
  const std::string before = text_of(folder_ / "trajectory.kitti");
  SessionRecorder again(folder_, without_loops(), {});
  ASSERT_TRUE(again.begin());
  again.add(sample_record(0));
  EXPECT_EQ(text_of(folder_ / "trajectory.kitti"), before);
  EXPECT_EQ(json()["complete"], true);
  again.end({}, std::chrono::seconds(1));
  ASSERT_TRUE(again.write());
  EXPECT_EQ(lines_of(folder_ / "trajectory.kitti"), 1U);
  EXPECT_FALSE(fs::exists(folder_ / "map.ply")) << "an earlier session's map is not this one's";
}

TEST_F(RecordedSession, RunThatBrokeOffKeepsThePosesAsTheyWereTracked) {
  SessionRecorder recorder(folder_, without_loops(), {});
  for (std::uint64_t i = 0; i < 20; ++i) recorder.add(sample_record(i));
  recorder.session().broke_off = "out of luck";
  recorder.end({}, std::chrono::seconds(1));
  ASSERT_TRUE(recorder.write());
  const auto kitti = read_trajectory(folder_ / "trajectory.kitti").value();
  ASSERT_EQ(kitti.poses.size(), 20U);
  EXPECT_TRUE(kitti.poses[19].isApprox(sample_pose(1.9), 1e-12));
  EXPECT_EQ(json()["complete"], false);
  EXPECT_EQ(json()["broke_off"], "out of luck");
}

TEST_F(RecordedSession, ProfileReadsBackAsItWas) {
  SessionDescription description;
  description.config.window.size = 7;
  SessionRecorder recorder(folder_, description, {});
  record(recorder);
  ASSERT_TRUE(recorder.write());
  const auto profile = load_profile(folder_ / "profile.toml");
  ASSERT_TRUE(profile) << profile.error().message;
  EXPECT_EQ(profile->window.size, 7);
}

TEST_F(RecordedSession, FolderThatVanishedIsAnErrorThatNamesTheFile) {
  SessionRecorder recorder(folder_ / "gone", {}, {CloudFormat::kPly});
  recorder.end({}, std::chrono::seconds(1));
  const auto written = recorder.write();
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, ::testing::HasSubstr("gone/trajectory.kitti"));
}

}  // namespace
}  // namespace sparsight
