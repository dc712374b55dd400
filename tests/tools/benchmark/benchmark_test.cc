#include "tools/benchmark/benchmark.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "tests/tools/benchmark/sample_benchmark.h"

namespace sparsight {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Status = BenchmarkEntry::Status;

// Two sequences with two numbers of rays; the runner remembers what it was asked to run.
class BenchmarkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::put_sequence(root_, "04", 120, 120);
    testing::put_sequence(root_, "11", 30, 0);
    options_ = {.output = root_ / "out", .rays = {64, 8}, .profile_text = "p", .program = "v1"};
  }

  Benchmark run() { return run_with(runner()); }

  Benchmark run_with(const ReplayRunner& runner) {
    ran_.clear();
    planned_ = 0;
    return run_benchmark(find_kitti_sequences(root_, {}).value(), options_, runner,
                         {.on_plan = [&](const auto& entries) { planned_ = entries.size(); },
                          .on_begin = [](std::size_t) {},
                          .on_progress = [](std::size_t, std::size_t) {},
                          .on_end = [](std::size_t, const auto&) {},
                          .interrupted = [&] { return interrupted_.load(); }});
  }

  ReplayRunner runner() {
    return [this](const ReplayRun& run, const ReplayWatch&) {
      remember(run);
      testing::put_session(run);
      return ReplayOutcome{};
    };
  }

  void remember(const ReplayRun& run) {
    const std::lock_guard lock(mutex_);
    ran_.push_back(run.session.filename().string());
  }

  const std::filesystem::path root_ = testing::fresh_folder();
  BenchmarkOptions options_;
  std::vector<std::string> ran_;
  std::size_t planned_ = 0;
  std::atomic<bool> interrupted_ = false;
  std::mutex mutex_;
};

TEST_F(BenchmarkTest, RunsEverySequenceWithEveryNumberOfRays) {
  const Benchmark benchmark = run();
  EXPECT_THAT(ran_, ElementsAre("04-64rays", "04-8rays", "11-64rays", "11-8rays"));
  EXPECT_EQ(planned_, 4U);
  EXPECT_TRUE(benchmark.all_done());
  ASSERT_TRUE(benchmark.entries[0].figures.accuracy.has_value());
  EXPECT_NEAR(*benchmark.entries[0].figures.accuracy->evaluation.kitti.t_rel_percent, 6.4, 1e-9);
  EXPECT_NEAR(*benchmark.entries[1].figures.accuracy->evaluation.kitti.t_rel_percent, 0.8, 1e-9);
}

TEST_F(BenchmarkTest, ReportsASequenceWithoutGroundTruthWithoutError) {
  const Benchmark benchmark = run();
  EXPECT_EQ(benchmark.entries[2].status, Status::kDone);
  EXPECT_EQ(benchmark.entries[2].figures.frames, 30U);
  EXPECT_FALSE(benchmark.entries[2].figures.accuracy.has_value());
}

TEST_F(BenchmarkTest, RunsNothingTwice) {
  run();
  const Benchmark again = run();
  EXPECT_THAT(ran_, IsEmpty());
  EXPECT_TRUE(again.all_done());
  EXPECT_NEAR(*again.entries[0].figures.accuracy->evaluation.kitti.t_rel_percent, 6.4, 1e-9);
}

TEST_F(BenchmarkTest, RunsAgainWhatHasOtherSettings) {
  run();
  options_.profile_text = "q";
  run();
  EXPECT_EQ(ran_.size(), 4U);
  options_.program = "v2";
  run();
  EXPECT_EQ(ran_.size(), 4U);
  options_.max_frames = 50;  // more than sequence 11 has: its runs stay what they are
  run();
  EXPECT_THAT(ran_, ElementsAre("04-64rays", "04-8rays"));
  options_.rays = {64, 16, 8};
  run();
  EXPECT_THAT(ran_, ElementsAre("04-16rays", "11-16rays"));
}

TEST_F(BenchmarkTest, RunsAgainWhatIsNotComplete) {
  const Benchmark benchmark = run();
  testing::put_session(benchmark.entries[1].run, false);
  std::filesystem::remove(benchmark.entries[2].run.session / "session.json");
  std::filesystem::remove(benchmark.entries[3].run.stamp());
  run();
  EXPECT_THAT(ran_, ElementsAre("04-8rays", "11-64rays", "11-8rays"));
}

TEST_F(BenchmarkTest, RunsAgainWhatIsDamaged) {
  const Benchmark benchmark = run();
  testing::put(benchmark.entries[0].run.session / "trajectory.kitti", "1 2 3");
  testing::put(benchmark.entries[1].run.session / "session.json", "{\"complete\": tr");
  EXPECT_TRUE(run().all_done());
  EXPECT_THAT(ran_, ElementsAre("04-64rays", "04-8rays"));
}

// The stamp must fall before the session is touched: a run killed half-way over an older session
// would look finished.
TEST_F(BenchmarkTest, DoesNotTakeAHalfOverwrittenSessionForAFinishedOne) {
  run();
  options_.program = "v2";
  run_with([this](const ReplayRun& run, const ReplayWatch&) {
    remember(run);
    return ReplayOutcome{ReplayOutcome::Status::kInterrupted, ""};
  });
  options_.program = "v1";
  run();
  EXPECT_EQ(ran_.size(), 4U);
}

TEST_F(BenchmarkTest, GoesOnAfterARunThatFails) {
  const Benchmark benchmark = run_with([](const ReplayRun& run, const ReplayWatch&) {
    if (run.rays == 64) return ReplayOutcome{ReplayOutcome::Status::kFailed, "no calibration"};
    testing::put_session(run);
    return ReplayOutcome{};
  });
  EXPECT_FALSE(benchmark.all_done());
  EXPECT_FALSE(benchmark.interrupted());
  EXPECT_EQ(benchmark.entries[0].status, Status::kFailed);
  EXPECT_EQ(benchmark.entries[0].message, "no calibration");
  EXPECT_EQ(benchmark.entries[1].status, Status::kDone);
  EXPECT_EQ(benchmark.entries[3].status, Status::kDone);
  EXPECT_TRUE(run().all_done());
  EXPECT_THAT(ran_, ElementsAre("04-64rays", "11-64rays"));
}

TEST_F(BenchmarkTest, CallsASessionThatEndedEarlyAFailure) {
  const Benchmark benchmark = run_with([](const ReplayRun& run, const ReplayWatch&) {
    testing::put_session(run, false);
    return ReplayOutcome{};
  });
  EXPECT_EQ(benchmark.entries[0].status, Status::kFailed);
  EXPECT_THAT(benchmark.entries[0].message, HasSubstr("ended before its source did"));
}

TEST_F(BenchmarkTest, CallsARunWithoutATrajectoryAFailure) {
  const Benchmark benchmark = run_with([](const ReplayRun& run, const ReplayWatch&) {
    testing::put(run.session / "session.json", "{\"complete\": true}");
    return ReplayOutcome{};
  });
  EXPECT_EQ(benchmark.entries[0].status, Status::kFailed);
  EXPECT_THAT(benchmark.entries[0].message, HasSubstr("trajectory.kitti: no such file"));
}

TEST_F(BenchmarkTest, StopsWhenInterruptedAndGoesOnFromThere) {
  const Benchmark benchmark = run_with([this](const ReplayRun& run, const ReplayWatch& watch) {
    remember(run);
    if (ran_.size() == 2) interrupted_ = true;
    if (watch.interrupted()) {
      testing::put_session(run, false);
      return ReplayOutcome{ReplayOutcome::Status::kInterrupted, ""};
    }
    testing::put_session(run);
    return ReplayOutcome{};
  });
  EXPECT_THAT(ran_, ElementsAre("04-64rays", "04-8rays"));
  EXPECT_TRUE(benchmark.interrupted());
  EXPECT_EQ(benchmark.entries[0].status, Status::kDone);
  EXPECT_EQ(benchmark.entries[1].status, Status::kNotRun);
  interrupted_ = false;
  EXPECT_TRUE(run().all_done());
  EXPECT_THAT(ran_, ElementsAre("04-8rays", "11-64rays", "11-8rays"));
}

TEST_F(BenchmarkTest, GivesEachRunToOneOfSeveralJobs) {
  options_.jobs = 3;
  EXPECT_TRUE(run().all_done());
  EXPECT_THAT(ran_, UnorderedElementsAre("04-64rays", "04-8rays", "11-64rays", "11-8rays"));
}

TEST_F(BenchmarkTest, SaysThatItsFolderCannotBeWritten) {
  options_.output = root_ / "poses/04.txt/out";
  const Benchmark benchmark = run();
  EXPECT_THAT(ran_, IsEmpty());
  EXPECT_EQ(benchmark.entries[0].status, Status::kFailed);
  EXPECT_THAT(benchmark.entries[0].message, HasSubstr("cannot be written"));
}

TEST_F(BenchmarkTest, TakesShortSegmentsOnlyWhereThePathHoldsNoOthers) {
  testing::put_sequence(root_, "05", 60, 60);
  const Benchmark benchmark = run();
  const auto& whole = *benchmark.entries[0].figures.accuracy;
  EXPECT_FALSE(whole.short_segments);
  EXPECT_EQ(whole.lengths_m.front(), 100.0);
  const auto& brief = *benchmark.entries[2].figures.accuracy;
  EXPECT_TRUE(brief.short_segments);
  EXPECT_EQ(brief.lengths_m.front(), 10.0);
  EXPECT_NEAR(*brief.evaluation.kitti.t_rel_percent, 6.4, 1e-9);
}

}  // namespace
}  // namespace sparsight
