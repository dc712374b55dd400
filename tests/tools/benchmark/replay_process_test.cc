#include "tools/benchmark/replay_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "tests/tools/benchmark/sample_benchmark.h"
#include "tools/evaluation/text_file.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

// A shell script stands for the program.
class ReplayProcess : public ::testing::Test {
 protected:
  ReplayOutcome run(const std::string& script) {
    testing::put(folder_ / "program", "#!/bin/sh\n" + script);
    std::filesystem::permissions(folder_ / "program", std::filesystem::perms::owner_all);
    std::filesystem::create_directories(run_.session);
    return replay_in_process(folder_ / "program", std::chrono::milliseconds(200))(
        run_,
        {.on_progress = [&](std::size_t frames) { most_frames_ = std::max(most_frames_, frames); },
         .interrupted = [&] { return interrupted_; }});
  }

  const std::filesystem::path folder_ = testing::fresh_folder();
  ReplayRun run_{.sequence = {.name = "04", .folder = "/data set/04", .images = 10},
                 .rays = 16,
                 .profile = "paper",
                 .max_frames = 7,
                 .session = folder_ / "04-16rays"};
  std::size_t most_frames_ = 0;
  bool interrupted_ = false;
};

TEST_F(ReplayProcess, PassesTheRunAsReplayTakesIt) {
  ASSERT_EQ(run("printf '%s\\n' \"$@\"").status, ReplayOutcome::Status::kDone);
  EXPECT_EQ(read_text_file(run_.log()).value(),
            "replay\n/data set/04\n--rays\n16\n--no-loops\n--profile\npaper\n--output\n" +
                run_.session.string() + "\n--quiet\n--max-frames\n7\n");
}

TEST_F(ReplayProcess, TellsTheLastLineOfWhatFailed) {
  const ReplayOutcome outcome = run("echo first; echo 'calib.txt: no such file' >&2; exit 3");
  EXPECT_EQ(outcome.status, ReplayOutcome::Status::kFailed);
  EXPECT_THAT(outcome.message, HasSubstr("exit code 3: calib.txt: no such file"));
}

TEST_F(ReplayProcess, SurvivesACrash) {
  const ReplayOutcome outcome = run("kill -9 $$");
  EXPECT_EQ(outcome.status, ReplayOutcome::Status::kFailed);
  EXPECT_THAT(outcome.message, HasSubstr("killed by signal 9"));
}

TEST_F(ReplayProcess, ReadsProgressFromTheJournal) {
  run("printf 'head\\na\\nb\\nc\\n' > '" + (run_.session / "frames.csv.partial").string() +
      "'; sleep 0.4");
  EXPECT_EQ(most_frames_, 3U);
}

TEST_F(ReplayProcess, IsNotDoneWhenInterruptedEvenIfTheChildEndsWell) {
  interrupted_ = true;
  EXPECT_EQ(run("exit 0").status, ReplayOutcome::Status::kInterrupted);
}

// The child did not hear the interruption itself; without the signal it would sleep on.
TEST_F(ReplayProcess, PassesAnInterruptionOn) {
  interrupted_ = true;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(run("exec sleep 60").status, ReplayOutcome::Status::kInterrupted);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(ReplayProcess, SaysThatTheProgramCannotBeStarted) {
  const ReplayOutcome outcome = replay_in_process(folder_ / "nothing")(
      run_, {.on_progress = [](std::size_t) {}, .interrupted = [] { return false; }});
  EXPECT_EQ(outcome.status, ReplayOutcome::Status::kFailed);
  EXPECT_THAT(outcome.message, HasSubstr("nothing: cannot be started"));
}

TEST(Fingerprint, TellsFilesApart) {
  const auto folder = testing::fresh_folder();
  testing::put(folder / "a", "a");
  testing::put(folder / "b", "b");
  EXPECT_EQ(fingerprint(folder / "a").value(), "af63dc4c8601ec8c");  // published FNV-1a vector
  EXPECT_NE(fingerprint(folder / "a").value(), fingerprint(folder / "b").value());
  EXPECT_FALSE(fingerprint(folder / "c"));
}

}  // namespace
}  // namespace sparsight
