#include "realtime/sync/exposure_pairing.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

using std::chrono::milliseconds;

Edge edge_at(bool rising, int ms) {
  return {EdgeLine::kExposure, rising, HostTime(milliseconds(1000 + ms))};
}

TEST(ExposurePairing, MakesAnExposureOfARiseAndAFall) {
  ExposurePairing pairing(true);
  EXPECT_FALSE(pairing.add(edge_at(true, 0)));
  const auto mark = pairing.add(edge_at(false, 5));
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->start, HostTime(milliseconds(1000)));
  EXPECT_EQ(mark->length, milliseconds(5));
  EXPECT_FALSE(mark->doubtful);
}

TEST(ExposurePairing, GivesAnExposureWithoutFallTheLengthOfTheLast) {
  ExposurePairing pairing(true);
  pairing.add(edge_at(true, 0));
  pairing.add(edge_at(false, 5));
  pairing.add(edge_at(true, 33));
  const auto mark = pairing.add(edge_at(true, 66));
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->start, HostTime(milliseconds(1033)));
  EXPECT_EQ(mark->length, milliseconds(5));
  EXPECT_TRUE(mark->doubtful);
  EXPECT_EQ(pairing.incomplete(), 1U);
  EXPECT_FALSE(pairing.add(edge_at(false, 71))->doubtful);
}

TEST(ExposurePairing, PutsTheStartOfAnExposureWithoutRiseBeforeItsFall) {
  ExposurePairing pairing(true);
  pairing.add(edge_at(true, 0));
  pairing.add(edge_at(false, 5));
  const auto mark = pairing.add(edge_at(false, 38));
  ASSERT_TRUE(mark);
  EXPECT_EQ(mark->start, HostTime(milliseconds(1033)));
  EXPECT_TRUE(mark->doubtful);
}

TEST(ExposurePairing, KnowsNoLengthToPutInBeforeItHasSeenOne) {
  ExposurePairing pairing(true);
  EXPECT_FALSE(pairing.add(edge_at(false, 5)));
  EXPECT_FALSE(pairing.add(edge_at(true, 33)));
  EXPECT_FALSE(pairing.add(edge_at(true, 66)));
}

TEST(ExposurePairing, DoubtsARiseSoonAfterAnother) {
  ExposurePairing pairing(true);
  pairing.add(edge_at(true, 0));
  pairing.add(edge_at(false, 5));
  pairing.add(edge_at(true, 33));
  pairing.add(edge_at(true, 34));
  EXPECT_TRUE(pairing.add(edge_at(false, 38))->doubtful);
}

TEST(ExposurePairing, TakesOnlyRisesOfATriggerLine) {
  ExposurePairing pairing(false);
  EXPECT_TRUE(pairing.add(edge_at(true, 0)));
  EXPECT_FALSE(pairing.add(edge_at(false, 1)));
  EXPECT_TRUE(pairing.add(edge_at(true, 33)));
}

}  // namespace
}  // namespace sparsight
