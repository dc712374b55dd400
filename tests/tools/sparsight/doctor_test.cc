#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/drivers/datasets/made_capture_folder.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

struct DoctorOutcome {
  int exit_code = 0;
  std::string out;
  std::string err;
};

DoctorOutcome run_doctor(const std::string& arguments) {
  CLI::App app;
  DoctorOutcome outcome;
  add_doctor(app, outcome.exit_code);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    app.parse("doctor " + arguments);
  } catch (const CLI::ParseError& error) {
    outcome.exit_code = app.exit(error) == 0 ? 0 : 2;
  }
  outcome.out = ::testing::internal::GetCapturedStdout();
  outcome.err = ::testing::internal::GetCapturedStderr();
  return outcome;
}

// A rig of which nothing is there.
std::string absent_rig() {
  const auto file = std::filesystem::path(::testing::TempDir()) / "absent_rig.toml";
  std::ofstream(file) << "[camera]\ndevice = \"/dev/no_such_camera\"\n"
                         "[trigger]\nchip = \"/dev/no_such_gpiochip\"\n"
                         "[lidar]\nbind_address = \"127.0.0.1\"\n";
  return file.string();
}

TEST(DoctorCommand, ARigThatIsNotThereIsNotFitAndTheReportSaysWhy) {
  const auto outcome =
      run_doctor("--rig " + absent_rig() + " --seconds 0.5 --folder " + ::testing::TempDir());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("/dev/no_such_camera: cannot open the camera"));
  EXPECT_THAT(outcome.out, HasSubstr("/dev/no_such_gpiochip: cannot watch line 0"));
  EXPECT_THAT(outcome.out, HasSubstr("The rig is not fit"));
}

TEST(DoctorCommand, PrintsJsonForMachines) {
  const auto outcome = run_doctor("--json --rig " + absent_rig() + " --seconds 0.5 --folder " +
                                  ::testing::TempDir());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("fit"), false);
}

TEST(DoctorCommand, LooksAtASourceInPlaceOfTheRig) {
  const testing::MadeCaptureFolder made;
  const auto outcome =
      run_doctor(made.folder.string() + " --json --overlay " + (made.folder / "o.png").string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto checks = nlohmann::json::parse(outcome.out).at("checks");
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[1].at("name"), "lidar on image");
  EXPECT_EQ(checks[1].at("verdict"), "warn") << "a round wall has no edges";
  EXPECT_EQ(run_doctor("/no/such.mcap").exit_code, 1);
}

TEST(DoctorCommand, ARigFileWithErrorsIsRefused) {
  const auto outcome = run_doctor("--rig /no/such/rig.toml");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("/no/such/rig.toml: cannot read this rig file"));
  EXPECT_EQ(run_doctor("").exit_code, 2);
}

}  // namespace
}  // namespace sparsight
