#include "tools/doctor/host_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace sparsight {
namespace {

using ::testing::HasSubstr;

TEST(DiskChecks, TheTrialLeavesNothingBehind) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "disk_trial";
  std::filesystem::create_directories(folder);
  const auto seen = observe_disk(folder, 2);
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_GT(seen->bytes_per_s, 0.0);
  EXPECT_GT(seen->free_bytes, 0.0);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(DiskChecks, AFolderThatIsNotThereIsNamed) {
  const auto checks = disk_checks(observe_disk("/no/such/folder", 1), RigConfig{});
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks[0].verdict, Verdict::kFail);
  EXPECT_THAT(checks[0].fix, HasSubstr("/no/such/folder"));
}

TEST(DiskChecks, ARecordingNeedsFramesAndPackets) {
  EXPECT_NEAR(recording_bytes_per_s(RigConfig{}), 14.4e6 + 0.91e6, 1.0);
}

TEST(DiskChecks, SpeedAndMinutesAreWeighed) {
  const auto verdicts = [](double megabytes_per_s, double free_gigabytes) {
    const auto checks =
        disk_checks(DiskObservation{free_gigabytes * 1e9, megabytes_per_s * 1e6}, RigConfig{});
    return std::pair(checks.at(0).verdict, checks.at(1).verdict);
  };
  EXPECT_EQ(verdicts(100, 100), std::pair(Verdict::kOk, Verdict::kOk));
  EXPECT_EQ(verdicts(20, 10), std::pair(Verdict::kWarn, Verdict::kWarn));
  EXPECT_EQ(verdicts(15, 2), std::pair(Verdict::kFail, Verdict::kFail));
  EXPECT_EQ(disk_checks(DiskObservation{55.116e9, 1e9}, RigConfig{}).at(1).found,
            "55.1 GB free, 60 minutes");
}

TEST(PrivilegeChecks, CapabilitiesAreReadFromTheStatus) {
  EXPECT_EQ(effective_capabilities("Name:\tx\nCapInh:\t00000000\nCapEff:\t000001ffffffffff\n"),
            0x1ffffffffffU);
  EXPECT_EQ(effective_capabilities("CapBnd:\t1\n"), 0U);
}

TEST(PrivilegeChecks, AnyOfTheWaysIsEnough) {
  const auto verdicts = [](const Privileges& privileges) {
    const auto checks = privilege_checks(privileges);
    return std::pair(checks.at(0).verdict, checks.at(1).verdict);
  };
  EXPECT_EQ(verdicts({.memlock_bytes = 8U << 20U}), std::pair(Verdict::kWarn, Verdict::kWarn));
  EXPECT_EQ(verdicts({.nice = true, .lock = true, .memlock_bytes = 0}),
            std::pair(Verdict::kOk, Verdict::kOk));
  EXPECT_EQ(verdicts({.rtprio = 95}), std::pair(Verdict::kOk, Verdict::kOk));
}

TEST(PrivilegeChecks, ThisProcessCanBeAsked) {
  EXPECT_EQ(privilege_checks(observe_privileges()).size(), 2U);
}

TEST(CalibrationCheck, NoneAndAnInverseAreFoundOut) {
  RigCalibration calibration;
  EXPECT_EQ(calibration_check(calibration).verdict, Verdict::kFail);
  calibration.camera = {.width = 800, .height = 600, .fx = 460};
  calibration.T_camera_lidar.linear() = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5).toRotationMatrix();
  EXPECT_EQ(calibration_check(calibration).verdict, Verdict::kOk);
  calibration.T_camera_lidar = calibration.T_camera_lidar.inverse();
  EXPECT_EQ(calibration_check(calibration).verdict, Verdict::kFail);
}

}  // namespace
}  // namespace sparsight
