#include "slam/lidar/sweep_sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "slam/points/sweep_motion.h"

namespace sparsight {
namespace {

constexpr std::size_t kLookedAt = 1000;
constexpr std::size_t kMostOfADirection = kMostSampled / 3;
// Golden section: steps around a sweep that never fall into the pattern of its rings.
constexpr double kStep = 0.61803398874989485;

constexpr std::size_t kMotionSlots = 128;  // of a 10 Hz sweep 0.8 ms each

std::size_t facing(const Eigen::Vector3f& normal) {
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  return static_cast<std::size_t>(largest);
}

}  // namespace

void sample_sweep(const Sweep& sweep, const Vector6d& twist, const SweepSurface& surface,
                  const Eigen::Isometry3d& T_keyframe_lidar, std::vector<Eigen::Vector3f>& out) {
  out.clear();
  if (sweep.returns.empty()) return;
  const std::size_t stride = std::max<std::size_t>(1, sweep.returns.size() / kLookedAt);
  const SweepMotion at_exposure(
      firing_span(sweep, stride), [&](double seconds) { return exp_se3(twist * seconds); },
      kMotionSlots);
  const Eigen::Isometry3f T = T_keyframe_lidar.cast<float>();
  std::array<std::size_t, 3> taken{};
  double place = 0.0;
  for (std::size_t i = 0; i < kLookedAt; ++i) {
    place += kStep;
    place -= std::floor(place);
    const auto index = static_cast<std::size_t>(place * static_cast<double>(sweep.returns.size()));
    const Eigen::Vector3f p = at_exposure.moved(sweep.returns[index]);
    if (!p.allFinite()) continue;
    const SweepSurface::Plane* plane = surface.at(T * p);
    if (plane == nullptr) continue;
    std::size_t& of_direction = taken[facing(plane->normal)];
    if (of_direction == kMostOfADirection) continue;
    ++of_direction;
    out.push_back(p);
  }
}

}  // namespace sparsight
