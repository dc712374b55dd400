#include "tools/session/progress.h"

#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <thread>

#include "tools/session/interrupt.h"

namespace sparsight {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

std::string text_of(std::FILE* file) {
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) text += static_cast<char>(c);
  return text;
}

// Frames for a good tenth of a second, with something to say in between.
std::string shown(Progress::Style style) {
  const File file(std::tmpfile(), &std::fclose);
  Progress progress(file.get(), style, 3);
  progress.frame(HostTime(std::chrono::milliseconds(0)), "first");
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  progress.frame(HostTime(std::chrono::milliseconds(100)), "tracked");
  progress.say("frame 1: image cut off");
  progress.end();
  return text_of(file.get());
}

TEST(Progress, TellsShareSpeedAndTimeLeft) {
  EXPECT_EQ(progress_text({.frames = 100, .total_frames = 4541, .wall_s = 2.0, .recorded_s = 10.0},
                          "tracked"),
            "frame 100/4541  2 %  50.0 frames/s  5.0 x real time  1:29 left  tracked");
  EXPECT_EQ(progress_text({.frames = 100, .wall_s = 2.0, .recorded_s = 10.0}, "predicted"),
            "frame 100  50.0 frames/s  5.0 x real time  predicted");
}

TEST(Progress, TerminalLineIsRewrittenAndMakesWayForWhatIsSaid) {
  const std::string text = shown(Progress::Style::kTerminal);
  EXPECT_EQ(text.rfind("\rframe 2/3  67 %", 0), 0U) << text;
  EXPECT_NE(text.find("tracked\x1b[K\r\x1b[Kframe 1: image cut off\n"), std::string::npos) << text;
}

TEST(Progress, ElsewhereLinesAreRareAndPlain) {
  EXPECT_EQ(shown(Progress::Style::kPlain), "frame 1: image cut off\n");
}

TEST(Progress, QuietStillTellsFaults) {
  EXPECT_EQ(shown(Progress::Style::kQuiet), "frame 1: image cut off\n");
}

TEST(InterruptRequest, IsPendingAfterTheSignalAndForgottenAfterwards) {
  {
    const InterruptRequest request;
    EXPECT_FALSE(request.pending());
    ASSERT_EQ(std::raise(SIGINT), 0);
    EXPECT_TRUE(request.pending());
  }
  EXPECT_FALSE(InterruptRequest().pending());
}

}  // namespace
}  // namespace sparsight
