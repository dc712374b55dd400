#include "drivers/datasets/trigger_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

HostTime at(std::chrono::nanoseconds since_start) { return HostTime(since_start); }

TEST(TriggerTime, IsTheExposure) {
  EXPECT_THAT(exposure_times({at(116ms), at(217ms), at(318ms)}, {at(100ms), at(200ms), at(300ms)}),
              ElementsAre(at(100ms), at(200ms), at(300ms)));
}

TEST(TriggerTime, IsTheUsualDelayBeforeAnImageWhoseScanIsMissing) {
  EXPECT_THAT(exposure_times({at(116ms), at(217ms), at(316ms), at(416ms)},
                             {at(100ms), std::nullopt, at(300ms)}),
              ElementsAre(at(100ms), at(201ms), at(300ms), at(400ms)));
}

TEST(TriggerTime, OfAnotherTurnIsNotTaken) {
  EXPECT_THAT(exposure_times({at(116ms), at(216ms), at(316ms)}, {at(100ms), at(300ms), at(300ms)}),
              ElementsAre(at(100ms), at(200ms), at(300ms)));
}

TEST(TriggerTime, IsNotTheExposureOfCamerasThatRunOnTheirOwn) {
  const std::vector<HostTime> arrivals{at(140ms), at(240ms), at(340ms)};
  EXPECT_EQ(exposure_times(arrivals, {at(100ms), at(200ms), at(300ms)}), arrivals);
  EXPECT_EQ(exposure_times(arrivals, {at(150ms), at(250ms), at(350ms)}), arrivals);
  EXPECT_EQ(exposure_times(arrivals, {}), arrivals);
}

}  // namespace
}  // namespace sparsight
