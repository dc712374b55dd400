#include "tools/benchmark/benchmark_progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sparsight {
namespace {

using std::chrono::seconds;
using ::testing::HasSubstr;

BenchmarkEntry entry(std::size_t frames, bool resumed = false) {
  return {.run = {.sequence = {.name = "04", .images = frames}, .rays = 16}, .resumed = resumed};
}

TEST(FrameTally, ForeseesTheTimeOfTheFramesLeft) {
  FrameTally tally({entry(100), entry(300), entry(5000, true)});
  EXPECT_EQ(tally.total(), 400U);
  EXPECT_EQ(tally.time_left(seconds(10)), "?");
  tally.advance(0, 50);
  EXPECT_EQ(tally.time_left(seconds(1000)), "1:56:40");  // 20 s a frame, 350 left
  tally.advance(0, 100);
  tally.advance(1, 300);
  EXPECT_EQ(tally.time_left(seconds(1000)), "0:00:00");
}

TEST(FrameTally, NeitherCountsBackNorBeyondTheEnd) {
  FrameTally tally({entry(100)});
  tally.advance(0, 60);
  tally.advance(0, 0);
  EXPECT_EQ(tally.done(), 60U);
  tally.advance(0, 1000);
  EXPECT_EQ(tally.done(), 100U);
}

TEST(FrameTally, ExpectsNoMoreOfARunThatEndedEarly) {
  FrameTally tally({entry(100), entry(100)});
  tally.advance(0, 20);
  tally.end(0);
  EXPECT_EQ(tally.total(), 120U);
  EXPECT_EQ(tally.time_left(seconds(20)), "0:01:40");
}

// What is written to a file, as a terminal or not.
std::string shown(Progress::Style style) {
  std::FILE* file = std::tmpfile();
  BenchmarkProgress progress(file, style);
  BenchmarkEntry failed = entry(100);
  progress.plan({failed, entry(50, true)});
  progress.begin(0);
  progress.progress(0, 40);
  failed.status = BenchmarkEntry::Status::kFailed;
  failed.message = "no calibration";
  progress.end(0, failed);
  std::rewind(file);
  std::string text(10'000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

TEST(BenchmarkProgress, WritesALinePerRunWhereNoTerminalIs) {
  const std::string text = shown(Progress::Style::kPlain);
  EXPECT_THAT(text, HasSubstr("2 runs: 1 finished earlier, 1 to do, 100 frames\n"));
  EXPECT_THAT(text, HasSubstr("1/1  04 with 16 rays: FAILED: no calibration"));
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(BenchmarkProgress, RewritesOneLineOnATerminal) {
  EXPECT_THAT(shown(Progress::Style::kTerminal),
              HasSubstr("\r04 with 16 rays: frame 40  | run 1/1  40 %"));
}

TEST(BenchmarkProgress, SaysNothingWhenQuiet) { EXPECT_EQ(shown(Progress::Style::kQuiet), ""); }

}  // namespace
}  // namespace sparsight
