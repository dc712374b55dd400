#include "tools/evaluation/association.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using ::testing::HasSubstr;

std::vector<HostTime> at_ms(std::initializer_list<int> instants) {
  std::vector<HostTime> times;
  for (const int instant : instants) {
    times.emplace_back(milliseconds(instant));
  }
  return times;
}

std::vector<std::pair<std::size_t, std::size_t>> plain(const std::vector<IndexPair>& pairs) {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  for (const IndexPair& pair : pairs) {
    result.emplace_back(pair.estimate, pair.truth);
  }
  return result;
}

TEST(Association, PairsEachOthersNearest) {
  const auto pairs =
      associate_by_time(at_ms({0, 100, 200}), at_ms({-5, 95, 104, 199}), milliseconds(20));
  EXPECT_THAT(plain(pairs),
              ::testing::ElementsAre(std::pair(0U, 0U), std::pair(1U, 2U), std::pair(2U, 3U)));
}

TEST(Association, LeavesOutWhatIsFurtherThanTheTolerance) {
  EXPECT_EQ(associate_by_time(at_ms({0}), at_ms({20}), milliseconds(20)).size(), 1U);
  EXPECT_EQ(associate_by_time(at_ms({0}), at_ms({21}), milliseconds(20)).size(), 0U);
}

TEST(Association, UsesNoPoseTwice) {
  const auto pairs = associate_by_time(at_ms({0, 6, 12}), at_ms({5}), milliseconds(20));
  EXPECT_THAT(plain(pairs), ::testing::ElementsAre(std::pair(1U, 0U)));
}

TEST(Association, TakesTheFirstOfRepeatedTimes) {
  const auto pairs = associate_by_time(at_ms({10, 10}), at_ms({8, 8, 8}), milliseconds(20));
  EXPECT_THAT(plain(pairs), ::testing::ElementsAre(std::pair(0U, 0U)));
}

RC_GTEST_PROP(Association, IsOneToOneInOrderAndSymmetric,
              (std::vector<std::uint16_t> a, std::vector<std::uint16_t> b)) {
  const auto to_times = [](std::vector<std::uint16_t>& instants) {
    std::sort(instants.begin(), instants.end());
    instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
    std::vector<HostTime> times;
    for (const int instant : instants) {
      times.emplace_back(milliseconds(2 * instant));
    }
    return times;
  };
  const std::vector<HostTime> estimate = to_times(a);
  // Odd offsets, so that no distance ties and the answer may not depend on the order of roles.
  std::vector<HostTime> truth = to_times(b);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth[i] += nanoseconds(1'000 * (i % 7 + 1));
  }
  const auto pairs = associate_by_time(estimate, truth, milliseconds(300));
  const auto swapped = associate_by_time(truth, estimate, milliseconds(300));
  RC_ASSERT(pairs.size() == swapped.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    RC_ASSERT(pairs[i].estimate == swapped[i].truth && pairs[i].truth == swapped[i].estimate);
    if (i == 0) continue;  // RC_ASSERT evaluates all of its expression
    RC_ASSERT(pairs[i].estimate > pairs[i - 1].estimate && pairs[i].truth > pairs[i - 1].truth);
  }
}

TEST(Association, GoesByIndexWhereNeitherHasTimes) {
  const auto pairs = associate(testing::straight_path(3), testing::straight_path(5), {});
  ASSERT_TRUE(pairs);
  EXPECT_EQ(pairs->size(), 3U);
  EXPECT_EQ(pairs->back().truth, 2U);
}

TEST(Association, AsksForTheTimesThatOneLacks) {
  Trajectory estimate = testing::straight_path(3);
  estimate.source = "est.txt";
  const auto pairs =
      associate(estimate, testing::timed(testing::straight_path(3), milliseconds(100)), {});
  ASSERT_FALSE(pairs);
  EXPECT_THAT(pairs.error().message, HasSubstr("est.txt has no times"));
  EXPECT_THAT(pairs.error().message, HasSubstr("--times"));
}

TEST(Association, SaysThatClocksDoNotMeet) {
  const auto a = testing::timed(testing::straight_path(3), milliseconds(100));
  const auto b =
      testing::timed(testing::straight_path(3), milliseconds(100), std::chrono::hours(1));
  const auto pairs = associate(a, b, milliseconds(20));
  ASSERT_FALSE(pairs);
  EXPECT_THAT(pairs.error().message, HasSubstr("3600.000000 to 3600.200000 s"));
  EXPECT_THAT(pairs.error().message, HasSubstr("same clock"));
}

}  // namespace
}  // namespace sparsight
