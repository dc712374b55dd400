#include "drivers/datasets/firing_time.h"

#include <cmath>
#include <numbers>

namespace sparsight {

void stamp_returns(std::vector<LidarReturn>& returns, const SweepTiming& sweep, HostTime exposure) {
  const double start_ns = static_cast<double>((sweep.start - exposure).count());
  const double turn_ns = static_cast<double>((sweep.end - sweep.start).count());
  for (LidarReturn& point : returns) {
    // In double: the float next to pi lies beyond it, and would fire before the turn starts.
    const double azimuth = std::atan2(double{point.p_lidar.y()}, double{point.p_lidar.x()});
    const double turned = 0.5 * (1.0 - azimuth / std::numbers::pi);
    point.from_exposure_ns = static_cast<std::int32_t>(std::lround(start_ns + turned * turn_ns));
  }
}

}  // namespace sparsight
