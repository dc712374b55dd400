#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/evaluation/paths.h"
#include "tools/session/atomic_file.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

struct EvaluateOutcome {
  int exit_code = 0;
  std::string out;
  std::string err;
};

// As main() does it, without the process.
EvaluateOutcome run_evaluate(const std::string& arguments) {
  CLI::App app;
  EvaluateOutcome outcome;
  add_evaluate(app, outcome.exit_code);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    app.parse("evaluate " + arguments);
  } catch (const CLI::ParseError& error) {
    outcome.exit_code = app.exit(error) == 0 ? 0 : 2;
  }
  outcome.out = ::testing::internal::GetCapturedStdout();
  outcome.err = ::testing::internal::GetCapturedStderr();
  return outcome;
}

class EvaluateCommand : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const auto file = folder_ / name;
    std::filesystem::create_directories(folder_);
    EXPECT_TRUE(write_file(file, text));
    return file.string();
  }
  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string truth_ = write("truth.txt", format_kitti(testing::straight_path(301).poses));
  const std::string estimate_ =
      write("estimate.txt", format_kitti(testing::straight_path(301, 1.01).poses));
};

TEST_F(EvaluateCommand, PrintsATableForPeople) {
  const EvaluateOutcome outcome = run_evaluate(estimate_ + " --ground-truth " + truth_);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("t_rel 1.000 %"));
  EXPECT_EQ(outcome.err, "");
}

TEST_F(EvaluateCommand, PrintsJsonForMachines) {
  // The file after the list of lengths is the estimate, not a length.
  const EvaluateOutcome outcome =
      run_evaluate("--json --step 1 --lengths 20,10,10 " + estimate_ + " --ground-truth " + truth_);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json.at("kitti").at("lengths").size(), 2U);
  EXPECT_EQ(json.at("kitti").at("lengths").at(0).at("length_m"), 10.0);
  EXPECT_EQ(json.at("kitti").at("lengths").at(0).at("segments"), 291);
}

TEST_F(EvaluateCommand, FailsOnABadFileWithItsName) {
  const std::string broken = write("broken.txt", "1 0 0\n");
  const EvaluateOutcome outcome = run_evaluate(broken + " --ground-truth " + truth_);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr(broken + ":1: 3 fields"));
}

TEST_F(EvaluateCommand, FailsWhenOneHasTimesAndTheOtherNot) {
  const std::string timed = write(
      "timed.tum",
      format_tum(testing::timed(testing::straight_path(301), std::chrono::milliseconds(100))));
  const EvaluateOutcome outcome = run_evaluate(estimate_ + " --ground-truth " + timed);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--times"));
}

TEST_F(EvaluateCommand, LoopsAreASessions) {
  const EvaluateOutcome outcome = run_evaluate(estimate_ + " --loops --ground-truth " + truth_);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("session.json: no such file"));
}

TEST_F(EvaluateCommand, RefusesUsageThatMakesNoSense) {
  const std::string files = estimate_ + " --ground-truth " + truth_;
  EXPECT_EQ(run_evaluate(estimate_).exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --lengths 0").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --lengths nan").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --lengths ten").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --step 0").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --step -1").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --rpe-delta 0").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --max-time-difference -1").exit_code, 2);
  EXPECT_EQ(run_evaluate(files + " --format xml").exit_code, 2);
  EXPECT_EQ(run_evaluate("--help").exit_code, 0);
}

}  // namespace
}  // namespace sparsight
