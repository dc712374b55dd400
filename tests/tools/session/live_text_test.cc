#include "tools/session/live_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

LiveView a_second_of_a_run() {
  LatencyHistogram poses;
  for (int i = 0; i < 30; ++i) poses.add(50ms);
  LiveView view;
  view.before.exposure_to_pose = poses.snapshot();
  for (int i = 0; i < 30; ++i) poses.add(20ms);
  view.now.exposure_to_pose = poses.snapshot();
  view.now.running = 12500ms;
  view.now.state = LiveState::kTracking;
  view.now.frames = 375;
  view.now.lidar.state = DeviceState::kGone;
  view.now.lidar.message = "no network";
  view.now.pose = LivePose{.T_world_camera = Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3))};
  return view;
}

TEST(LiveLine, ShowsTheLastSecondTheSensorsAndWhatIsLeftOut) {
  LiveView view = a_second_of_a_run();
  const std::string line = live_line(view);
  EXPECT_NE(line.find("12.5 s  tracking  375 frames  pose after 20.5/20.5 ms"), std::string::npos)
      << line;
  EXPECT_NE(line.find("lidar gone"), std::string::npos);
  EXPECT_NE(line.find("not recording"), std::string::npos);
  EXPECT_EQ(line.find("overloaded"), std::string::npos);
  view.now.shed = Shed::kLoopSearch;
  EXPECT_NE(live_line(view).find("overloaded: left out up to loop search"), std::string::npos);
}

TEST(LiveJson, IsOneLineThatAMachineReads) {
  LiveView view = a_second_of_a_run();
  view.now.pose_searches_cut = 7;
  view.recorder = RecorderReport{.state = RecorderState::kDiskFull, .message = "full"};
  const std::string line = live_json(view);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json.at("state"), "tracking");
  EXPECT_EQ(json.at("exposure_to_pose_ms").at("count"), 30);
  EXPECT_EQ(json.at("lidar").at("message"), "no network");
  EXPECT_EQ(json.at("left_out").at("pose_searches_cut"), 7);
  EXPECT_EQ(json.at("T_odom_camera").at("position_m"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(json.at("recorder").at("state"), "ended: the disk is full");
}

TEST(LiveJson, HasThePoseInTheMapWhileItIsKnownWhereTheSubmapLies) {
  LiveView view = a_second_of_a_run();
  view.now.map.T_map_world = Eigen::Isometry3d(Eigen::Translation3d(10, 0, 0));
  auto json = nlohmann::json::parse(live_json(view));
  EXPECT_EQ(json.at("T_map_camera").at("position_m"), (std::vector<double>{11, 2, 3}));
  EXPECT_EQ(json.at("T_map_odom").at("position_m"), (std::vector<double>{10, 0, 0}));
  view.now.pose->submap = 1;  // of which the background has not heard yet
  json = nlohmann::json::parse(live_json(view));
  EXPECT_FALSE(json.contains("T_map_camera"));
  EXPECT_EQ(json.at("submap"), 1);
}

}  // namespace
}  // namespace sparsight
