#include "tools/benchmark/benchmark_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/benchmark/sample_benchmark.h"

namespace sparsight {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

BenchmarkEntry entry(const std::string& sequence, int rays, std::size_t frames,
                     std::size_t truth_frames, double stretch, bool short_segments = false) {
  BenchmarkEntry result{.run = {.sequence = {.name = sequence, .images = frames}, .rays = rays}};
  result.status = BenchmarkEntry::Status::kDone;
  result.figures = {.frames = frames, .tracking_median_ms = 1.25, .tracking_p99_ms = 4.5};
  if (truth_frames > 0) {
    EvaluationOptions options;
    if (short_segments) options.segments.lengths_m = {10, 20, 30, 40, 50};
    result.figures.accuracy = {evaluate_trajectories(testing::straight_path(frames, stretch),
                                                     testing::straight_path(truth_frames), options)
                                   .value(),
                               options.segments.lengths_m, short_segments};
  }
  return result;
}

Benchmark sample() {
  Benchmark benchmark{.options = {.rays = {64, 8}}};
  benchmark.entries = {entry("00", 64, 150, 150, 1.01),      entry("00", 8, 150, 150, 1.02),
                       entry("01", 64, 150, 150, 1.03),      entry("01", 8, 150, 150, 1.06),
                       entry("04", 64, 60, 271, 1.50, true), entry("04", 8, 60, 271, 1.50, true),
                       entry("11", 64, 30, 0, 1.0),          entry("11", 8, 30, 0, 1.0)};
  return benchmark;
}

TEST(BenchmarkReport, PutsOursBesideThePapersAndAveragesRows) {
  const std::string text = benchmark_markdown(sample(), "sparsight benchmark K");
  EXPECT_THAT(text, HasSubstr("`sparsight benchmark K`"));
  EXPECT_THAT(
      text,
      ContainsRegex(
          R"(\| +00 \| +150 \| +1\.00 \| +2\.00 \| +0\.93 \| +0\.93 \| +0\.95 \| +1\.05 \|)"));
  // 2 = (1 + 3) / 2 and so on; the paper's 64 rays: (0.93 + 1.47) / 2.
  EXPECT_THAT(
      text, ContainsRegex(
                R"(\| +mean \| +\| +2\.00 \| +4\.00 \| +1\.20 \| +1\.01 \| +4\.10 \| +1\.46 \|)"));
}

TEST(BenchmarkReport, MarksWhatCannotStandBesideThePaperAndKeepsItOutOfTheMean) {
  const std::string text = benchmark_markdown(sample(), "");
  EXPECT_THAT(text, HasSubstr("50.00‡"));
  EXPECT_THAT(text, HasSubstr("‡ The path is too short"));
  EXPECT_THAT(text, HasSubstr("† 04: only the first 60 of 271 frames, 59 m; not in the mean"));
}

TEST(BenchmarkReport, HasNoFootnotesWithoutNeed) {
  Benchmark benchmark = sample();
  benchmark.entries.resize(4);
  const std::string text = benchmark_markdown(benchmark, "");
  EXPECT_THAT(text, Not(HasSubstr("‡")));
  EXPECT_THAT(text, Not(HasSubstr("†")));
  EXPECT_THAT(text, Not(HasSubstr("Not complete")));
}

TEST(BenchmarkReport, NamesFailuresAndWhatIsLeft) {
  Benchmark benchmark = sample();
  benchmark.entries[3].status = BenchmarkEntry::Status::kFailed;
  benchmark.entries[3].message = "no calibration";
  benchmark.entries[7].status = BenchmarkEntry::Status::kNotRun;
  const std::string text = benchmark_markdown(benchmark, "");
  EXPECT_THAT(text, HasSubstr("FAILED: 01 with 8 rays: no calibration"));
  EXPECT_THAT(text, ContainsRegex(R"(\| +01 \| +150 \| +3\.00 \| +failed \|)"));
  EXPECT_THAT(text, HasSubstr("the same command goes on from here"));
  // The mean of 8 rays is of one sequence, that of 64 of two.
  EXPECT_THAT(text, HasSubstr("2.00 (1) |"));
}

TEST(BenchmarkReport, HasTheKeysMachinesRelyOn) {
  const auto json = nlohmann::json::parse(benchmark_json(sample(), "sparsight benchmark K"));
  EXPECT_EQ(json.at("command"), "sparsight benchmark K");
  EXPECT_EQ(json.at("profile"), "default");
  EXPECT_TRUE(json.at("max_frames").is_null());
  EXPECT_EQ(json.at("complete"), true);
  ASSERT_EQ(json.at("runs").size(), 8U);
  const auto& run = json.at("runs").at(3);
  EXPECT_EQ(run.at("sequence"), "01");
  EXPECT_EQ(run.at("rays"), 8);
  EXPECT_EQ(run.at("status"), "done");
  EXPECT_EQ(run.at("comparable"), true);
  EXPECT_NEAR(run.at("t_rel_percent").get<double>(), 6.0, 1e-9);
  EXPECT_EQ(run.at("tracking_median_ms"), 1.25);
  EXPECT_TRUE(run.at("times_real_time").is_null());
  EXPECT_EQ(json.at("runs").at(4).at("comparable"), false);
  EXPECT_EQ(json.at("runs").at(4).at("truth_frames"), 271);
  EXPECT_TRUE(json.at("runs").at(6).at("t_rel_percent").is_null());
  EXPECT_NEAR(json.at("means").at(0).at("t_rel_percent").get<double>(), 2.0, 1e-9);
  EXPECT_EQ(json.at("means").at(1).at("sequences"), 2);
  EXPECT_EQ(json.at("published").size(), 3U);
}

TEST(BenchmarkReport, HasNoMeanOfNothing) {
  Benchmark benchmark = sample();
  benchmark.entries.erase(benchmark.entries.begin(), benchmark.entries.begin() + 4);
  EXPECT_THAT(benchmark_markdown(benchmark, ""),
              ContainsRegex(R"(\| +mean \| +\| +– \| +– \| +– \| +– \| +– \| +– \|)"));
  const auto json = nlohmann::json::parse(benchmark_json(benchmark, ""));
  EXPECT_TRUE(json.at("means").at(0).at("t_rel_percent").is_null());
}

}  // namespace
}  // namespace sparsight
