#include "realtime/executor/latency_histogram.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

RC_GTEST_PROP(LatencyHistogram, KnowsPercentilesToASixteenthOfTheirSize, ()) {
  auto values_us = *rc::gen::nonEmpty(
      rc::gen::container<std::vector<std::int64_t>>(rc::gen::inRange<std::int64_t>(0, 10'000'000)));
  LatencyHistogram histogram;
  for (const std::int64_t us : values_us) histogram.add(std::chrono::microseconds(us));
  std::sort(values_us.begin(), values_us.end());
  const LatencySnapshot snapshot = histogram.snapshot();
  RC_ASSERT(snapshot.count == values_us.size());
  RC_ASSERT(snapshot.max == std::chrono::microseconds(values_us.back()));
  const std::size_t middle = (values_us.size() + 1) / 2 - 1;
  const double truth = static_cast<double>(values_us[middle]);
  const double found = 1e-3 * static_cast<double>(snapshot.percentile(0.5).count());
  RC_ASSERT(found >= truth);
  RC_ASSERT(found <= truth + 1.0 + truth / 16.0);
}

TEST(LatencyHistogram, CountsWhatIsTooShortOrTooLongInItsEnds) {
  LatencyHistogram histogram;
  histogram.add(-5ms);
  histogram.add(0ns);
  histogram.add(100h);
  EXPECT_EQ(histogram.snapshot().count, 3U);
  EXPECT_EQ(histogram.snapshot().max, 100h);
}

TEST(LatencyHistogram, TellsWhatWasAddedSinceAnEarlierLook) {
  LatencyHistogram histogram;
  for (int i = 0; i < 100; ++i) histogram.add(1ms);
  const LatencySnapshot before = histogram.snapshot();
  for (int i = 0; i < 10; ++i) histogram.add(20ms);
  const LatencySnapshot lately = histogram.snapshot().since(before);
  EXPECT_EQ(lately.count, 10U);
  EXPECT_GE(lately.percentile(0.01), 20ms);
  EXPECT_EQ(LatencySnapshot{}.percentile(0.5), 0ns);
}

}  // namespace
}  // namespace sparsight
