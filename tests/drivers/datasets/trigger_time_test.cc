#include "drivers/datasets/trigger_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

HostTime host_at(std::chrono::nanoseconds since_start) { return HostTime(since_start); }

TEST(TriggerTime, IsTheExposure) {
  EXPECT_THAT(exposure_times({host_at(116ms), host_at(217ms), host_at(318ms)},
                             {host_at(100ms), host_at(200ms), host_at(300ms)}),
              ElementsAre(host_at(100ms), host_at(200ms), host_at(300ms)));
}

TEST(TriggerTime, IsTheUsualDelayBeforeAnImageWhoseScanIsMissing) {
  EXPECT_THAT(exposure_times({host_at(116ms), host_at(217ms), host_at(316ms), host_at(416ms)},
                             {host_at(100ms), std::nullopt, host_at(300ms)}),
              ElementsAre(host_at(100ms), host_at(201ms), host_at(300ms), host_at(400ms)));
}

TEST(TriggerTime, OfAnotherTurnIsNotTaken) {
  EXPECT_THAT(exposure_times({host_at(116ms), host_at(216ms), host_at(316ms)},
                             {host_at(100ms), host_at(300ms), host_at(300ms)}),
              ElementsAre(host_at(100ms), host_at(200ms), host_at(300ms)));
}

TEST(TriggerTime, IsNotTheExposureOfCamerasThatRunOnTheirOwn) {
  const std::vector<HostTime> arrivals{host_at(140ms), host_at(240ms), host_at(340ms)};
  EXPECT_EQ(exposure_times(arrivals, {host_at(100ms), host_at(200ms), host_at(300ms)}), arrivals);
  EXPECT_EQ(exposure_times(arrivals, {host_at(150ms), host_at(250ms), host_at(350ms)}), arrivals);
  EXPECT_EQ(exposure_times(arrivals, {}), arrivals);
}

}  // namespace
}  // namespace sparsight
