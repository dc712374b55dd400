#include "tools/doctor/disk_checks.h"

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

}  // namespace
}  // namespace sparsight
