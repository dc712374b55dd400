#include "tools/session/session_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/tools/session/sample_session.h"
#include "tools/session/session_text.h"

namespace sparsight {
namespace {

TEST(Percentile, IsTheSmallestValueThatEnoughDoNotExceed) {
  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i) hundred.push_back(i);
  EXPECT_EQ(percentile(hundred, 0.5), 50.0);
  EXPECT_EQ(percentile(hundred, 0.99), 99.0);
  EXPECT_EQ(percentile(hundred, 1.0), 100.0);
  EXPECT_EQ(percentile({7.0}, 0.99), 7.0);
  EXPECT_EQ(percentile({}, 0.5), 0.0);
}

RC_GTEST_PROP(Percentile, LeavesTheRightShareBelow, ()) {
  const auto values = *rc::gen::nonEmpty(rc::gen::arbitrary<std::vector<int>>());
  const double share = *rc::gen::inRange(1, 101) / 100.0;
  const std::vector<double> numbers(values.begin(), values.end());
  const double result = percentile(numbers, share);
  const auto at_most = [&](double bound) {
    return static_cast<double>(
        std::count_if(numbers.begin(), numbers.end(), [&](double v) { return v <= bound; }));
  };
  RC_ASSERT(at_most(result) >= share * static_cast<double>(numbers.size()) - 1e-9);
  RC_ASSERT(std::count(numbers.begin(), numbers.end(), result) > 0);
  RC_ASSERT(at_most(std::nextafter(result, -1e300)) < share * static_cast<double>(numbers.size()));
}

TEST(SessionSummary, FailsIfNothingWasTrackedOrItBrokeOff) {
  Session session = sample_session(30);
  EXPECT_FALSE(failure_of(session));
  session.broke_off = "stopped on request";
  EXPECT_THAT(failure_of(session).value().message, ::testing::HasSubstr("stopped on request"));
  session = sample_session(30);
  for (std::size_t i = 1; i < 30; ++i) {
    session.frames[i].status = FrameOutcome::Status::kPredicted;
  }
  EXPECT_THAT(failure_of(session).value().message,
              ::testing::HasSubstr("no frame could be tracked"));
  EXPECT_FALSE(failure_of(sample_session(1))) << "one frame has nothing to be tracked against";
  EXPECT_TRUE(failure_of(sample_session(0)));
}

TEST(SessionText, TellsWhereHowFarOffHowFastAndWhatWasWrong) {
  const auto truth = std::filesystem::path(::testing::TempDir()) / "text_truth.txt";
  Session session = sample_session(300, truth);
  session.notes.emplace_back("take care");
  const std::string text = session_text(session, "session-04");
  for (const char* part :
       {"300 in 29.9 s", "299 tracked, 1 predicted, 38 keyframes", "t_rel 0.", "ATE 0.",
        "100.0 frames/s, 10.0 x real time", "1 malformed", "take care", "session-04"}) {
    EXPECT_THAT(text, ::testing::HasSubstr(part));
  }
}

}  // namespace
}  // namespace sparsight
