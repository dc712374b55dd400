#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "tests/tools/benchmark/sample_benchmark.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

struct BenchmarkOutcome {
  int exit_code = 0;
  std::string err;
};

// As main() does it, without the process.
BenchmarkOutcome run_benchmark_command(const std::string& arguments) {
  CLI::App app;
  BenchmarkOutcome outcome;
  add_benchmark(app, outcome.exit_code);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  try {
    app.parse("benchmark " + arguments);
  } catch (const CLI::ParseError& error) {
    outcome.exit_code = app.exit(error) == 0 ? 0 : 2;
  }
  ::testing::internal::GetCapturedStdout();
  outcome.err = ::testing::internal::GetCapturedStderr();
  return outcome;
}

TEST(BenchmarkCommand, RefusesUsageThatMakesNoSense) {
  EXPECT_EQ(run_benchmark_command("").exit_code, 2);
  EXPECT_EQ(run_benchmark_command("K --rays 0").exit_code, 2);
  EXPECT_EQ(run_benchmark_command("K --rays many").exit_code, 2);
  EXPECT_EQ(run_benchmark_command("K --jobs 0").exit_code, 2);
  EXPECT_EQ(run_benchmark_command("K --max-frames 0").exit_code, 2);
  EXPECT_EQ(run_benchmark_command("K --profile no-such-profile").exit_code, 2);
  EXPECT_EQ(run_benchmark_command("--help").exit_code, 0);
}

TEST(BenchmarkCommand, SaysWhichFolderItNeeds) {
  const BenchmarkOutcome outcome = run_benchmark_command(testing::fresh_folder().string());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("holds no folder sequences"));
}

}  // namespace
}  // namespace sparsight
