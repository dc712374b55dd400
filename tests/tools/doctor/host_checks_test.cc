#include "tools/doctor/host_checks.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

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
