#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/build_paths.h"
#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using testing::recordings;

// The errors over 10 to 50 m of a replay with the one configuration for everything.
json replay_and_evaluate(const fs::path& source, const fs::path& truth, const std::string& rays,
                         const std::string& profile) {
  const fs::path session = scratch_folder() / "session";
  const ProgramRun replay = run_sparsight({"replay", source, "--rays", rays, "--profile", profile,
                                           "--output", session, "--no-map", "--quiet"});
  EXPECT_EQ(replay.exit_code, 0) << replay.errors;
  const ProgramRun evaluation =
      run_sparsight({"evaluate", session / "trajectory.kitti", "--ground-truth", truth, "--lengths",
                     "10,20,30,40,50", "--json"});
  EXPECT_EQ(evaluation.exit_code, 0) << evaluation.errors;
  json result = json::parse(evaluation.output);
  result["session"] = json::parse(text_of(session / "session.json"));
  return result;
}

class RealRecording : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!fs::exists(recordings() / "kitti")) {
      GTEST_SKIP() << "no recordings in " << recordings() << "; set SPARSIGHT_DATA to their folder";
    }
  }
};

TEST_P(RealRecording, Odometry04StaysWithinItsBounds) {
  const fs::path kitti = recordings() / "kitti" / "odometry";
  const json result = replay_and_evaluate(kitti / "sequences" / "04", kitti / "poses" / "04.txt",
                                          GetParam(), "default");
  EXPECT_LE(result.at("kitti").at("t_rel_percent").get<double>(), 0.9) << result.dump(1);
  EXPECT_LE(result.at("ate").at("rmse_m").get<double>(), 0.06) << "measured: 0.018, 0.046, 0.016";
  EXPECT_LE(result.at("kitti").at("r_rel_deg_per_m").get<double>(), 0.005);
  EXPECT_NE(result.at("session").at("notes").dump().find("k1"), std::string::npos)
      << "what the images show of the camera is told";
  EXPECT_EQ(result.at("session").at("predicted"), 0);
}

TEST_P(RealRecording, Drive0005StaysWithinItsBounds) {
  const fs::path drive =
      recordings() / "kitti" / "raw" / "2011_09_26" / "2011_09_26_drive_0005_sync";
  const json result =
      replay_and_evaluate(drive, drive / "poses_camera_0.txt", GetParam(), "default");
  EXPECT_LE(result.at("kitti").at("r_rel_deg_per_m").get<double>(), 0.016) << result.dump(1);
  EXPECT_LE(result.at("ate").at("rmse_m").get<double>(), 0.30);
  // The first steps of this drive are found in a wrong place, 0.1 to 0.2 m off; the next frame may
  // be refused for the acceleration that the way back would be.
  EXPECT_LE(result.at("session").at("predicted"), 1);
}

TEST_P(RealRecording, PaperProfileCompletesBoth) {
  const fs::path kitti = recordings() / "kitti";
  const fs::path drive = kitti / "raw" / "2011_09_26" / "2011_09_26_drive_0005_sync";
  for (const auto& [source, truth] :
       {std::pair{kitti / "odometry" / "sequences" / "04", kitti / "odometry" / "poses" / "04.txt"},
        std::pair{drive, drive / "poses_camera_0.txt"}}) {
    const json result = replay_and_evaluate(source, truth, GetParam(), "paper");
    EXPECT_TRUE(result.at("session").at("complete").get<bool>()) << source;
  }
}

INSTANTIATE_TEST_SUITE_P(Rays, RealRecording, ::testing::Values("64", "16", "8"),
                         [](const auto& instance) {
                           return std::string("Keeping") + instance.param;
                         });

}  // namespace
}  // namespace sparsight
