#include "tools/doctor/recording_examination.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "drivers/recording/recording_source.h"
#include "tests/drivers/datasets/small_dataset.h"
#include "tests/tools/session/made_walk.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

// A second among columns, with an overlay of its own.
class RecordedRig : public ::testing::Test {
 protected:
  struct Walk {
    testing::TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "walk.mcap";
    RigConfig rig;
  };
  static const Walk& walk() {
    static const Walk kWalk;
    static const bool kMade = [] {
      SimulationOptions options = testing::small_options(1.2);
      options.width = 400;
      options.height = 300;
      simulated::Scene scene = testing::bare_room();
      simulated::SceneBuilder build(scene, 2);
      const int white = scene.library.add(simulated::Material{.albedo = 0.95F});
      for (const float x : {-3.0F, -1.5F, 1.0F, 2.5F, 4.5F}) {
        build.column({x, 0.5F - x * 0.3F, 0}, 0.2F, 3.0F, 12, white);
      }
      SimulatedRig rig(options, std::move(scene));
      const_cast<Walk&>(kWalk).rig = rig.rig_config();
      testing::write_recording(kWalk.file, testing::gather_events(rig).all, rig.rig_config());
      return true;
    }();
    EXPECT_TRUE(kMade);
    return kWalk;
  }
  std::filesystem::path overlay() const { return walk().folder.path() / "overlay.png"; }

  std::vector<Check> checks_with(const std::optional<RigConfig>& rig = std::nullopt) {
    const auto checks = examine_recording(walk().file, rig, overlay());
    EXPECT_TRUE(checks) << checks.error().message;
    return checks.value_or(std::vector<Check>{});
  }
  static Check named(const std::vector<Check>& checks, std::string_view name) {
    for (const Check& check : checks) {
      if (check.name == name) return check;
    }
    ADD_FAILURE() << "no check is named " << name;
    return {};
  }
  static double figure(const Check& check, std::string_view name) {
    for (const auto& [key, value] : check.figures) {
      if (key == name) return value;
    }
    ADD_FAILURE() << check.name << " has no figure " << name;
    return 0.0;
  }
  // The calibration with what the LiDAR sees turned about one of the camera's axes.
  static RigConfig turned(const Eigen::Vector3d& axis, double degrees) {
    RigConfig rig = walk().rig;
    rig.calibration.T_camera_lidar =
        Eigen::AngleAxisd(degrees * M_PI / 180.0, axis) * rig.calibration.T_camera_lidar;
    return rig;
  }
};

TEST_F(RecordedRig, ThatIsGoodIsGoodInEveryWay) {
  const auto checks = checks_with();
  for (const Check& check : checks) {
    EXPECT_EQ(check.verdict, Verdict::kOk) << check.name << ": " << check.found << check.fix;
  }
  EXPECT_DOUBLE_EQ(figure(named(checks, "edges matched"), "share"), 1.0);
  EXPECT_LT(figure(named(checks, "camera clock"), "edge_jitter_us"), 20.0);
  EXPECT_LT(figure(named(checks, "lidar clock"), "uncertainty_us"), 200.0);
  EXPECT_GT(figure(named(checks, "lidar on image"), "share_of_turns_worse"), 0.9);
  EXPECT_THAT(named(checks, "lidar on image").found, HasSubstr("overlay.png"));
  const cv::Mat picture = cv::imread(overlay().string());
  EXPECT_EQ(picture.cols, 400);
  EXPECT_EQ(picture.rows, 300);
}

TEST_F(RecordedRig, WhoseLidarWasTurnedByOneDegreeIsNotFitAndToldWhereTo) {
  const Check right = named(checks_with(turned(Eigen::Vector3d::UnitY(), 1.0)), "lidar on image");
  EXPECT_EQ(right.verdict, Verdict::kFail) << right.found;
  EXPECT_THAT(right.fix, HasSubstr("to the left"));
  EXPECT_NEAR(figure(right, "best_turn_y_deg"), -1.0, 0.26);
  EXPECT_LT(figure(right, "share_of_turns_worse"), 0.8);
  const Check left = named(checks_with(turned(Eigen::Vector3d::UnitY(), -1.0)), "lidar on image");
  EXPECT_EQ(left.verdict, Verdict::kFail) << left.found;
  EXPECT_THAT(left.fix, HasSubstr("to the right"));
}

TEST_F(RecordedRig, WithoutEdgesSaysSo) {
  const auto file = walk().folder.path() / "no_edges.mcap";
  auto source = RecordingSource::open(walk().file).value();
  std::vector<RigEvent> events;
  while (auto event = source->next()) {
    if (!std::holds_alternative<Edge>(*event)) events.push_back(std::move(*event));
  }
  testing::write_recording(file, events, walk().rig);
  const auto checks = examine_recording(file, std::nullopt, "");
  ASSERT_TRUE(checks) << checks.error().message;
  EXPECT_EQ(named(*checks, "edges matched").verdict, Verdict::kFail);
  EXPECT_EQ(named(*checks, "exposure edges").verdict, Verdict::kFail);
  EXPECT_EQ(named(*checks, "lidar on image").verdict, Verdict::kWarn) << "it cannot be told";
}

TEST_F(RecordedRig, ThatDoesNotExistIsAnError) {
  EXPECT_FALSE(examine_recording("/no/such/file.mcap", std::nullopt, ""));
}

}  // namespace
}  // namespace sparsight
