#include "drivers/datasets/firing_time.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

TEST(FiringTime, RunsClockwiseFromTheBack) {
  const HostTime exposure(1000s);
  const SweepTiming sweep{exposure - 40ms, exposure + 60ms};
  std::vector<LidarReturn> returns(5);
  returns[0].p_lidar = {-5, 1e-6F, 0};  // back, from the left: just after the start
  returns[1].p_lidar = {0, 5, 1};       // left
  returns[2].p_lidar = {5, 0, -1};      // front
  returns[3].p_lidar = {0, -5, 0};      // right
  returns[4].p_lidar = {-5, -1e-6F, 0};
  stamp_returns(returns, sweep, exposure);
  EXPECT_NEAR(returns[0].from_exposure_ns, -40e6, 10);
  EXPECT_NEAR(returns[1].from_exposure_ns, -15e6, 10);
  EXPECT_NEAR(returns[2].from_exposure_ns, 10e6, 10);
  EXPECT_NEAR(returns[3].from_exposure_ns, 35e6, 10);
  EXPECT_NEAR(returns[4].from_exposure_ns, 60e6, 10);
}

}  // namespace
}  // namespace sparsight
