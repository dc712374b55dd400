#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/sweep.h"

namespace sparsight {

// When the returns of a sweep were fired, relative to the exposure. Looks at every `stride`-th.
struct FiringSpan {
  std::int32_t first_ns = 0;
  std::int32_t last_ns = 0;
};
FiringSpan firing_span(const Sweep& sweep, std::size_t stride = 1);

// Moves the returns of a sweep from where they were measured into one frame: a table, as a sweep
// has 100,000 firings and the exponential map is dear. Of 512 slots of a 10 Hz sweep each lasts
// 0.2 ms, 6 mm at 30 m/s. Of a motion-compensated sweep there is one. Real-time-safe if `motion`
// is.
class SweepMotion {
 public:
  static constexpr std::size_t kMostSlots = 512;

  // motion(seconds): the pose of the LiDAR in that frame so long after the exposure.
  template <typename Motion>
  SweepMotion(const FiringSpan& span, const Motion& motion, std::size_t slots = kMostSlots)
      : first_ns_(span.first_ns),
        slots_(span.last_ns > span.first_ns ? std::min(slots, kMostSlots) : 1),
        slot_ns_((static_cast<double>(span.last_ns) - span.first_ns) /
                 static_cast<double>(slots_)) {
    for (std::size_t i = 0; i < slots_; ++i) {
      const double seconds = 1e-9 * (first_ns_ + (static_cast<double>(i) + 0.5) * slot_ns_);
      const Eigen::Isometry3d T = motion(seconds);
      table_[i] = T.matrix().template cast<float>();
    }
  }

  Eigen::Vector3f moved(const LidarReturn& r) const {
    std::size_t slot = 0;
    if (slots_ > 1) {
      const double at = (static_cast<double>(r.from_exposure_ns) - first_ns_) / slot_ns_;
      slot = static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(slots_ - 1)));
    }
    // Whole columns of four, which are one register each.
    const Eigen::Matrix4f& T = table_[slot];
    const Eigen::Vector3f& p = r.p_lidar;
    const Eigen::Vector4f q = T.col(0) * p.x() + (T.col(1) * p.y() + T.col(2) * p.z()) + T.col(3);
    return q.head<3>();
  }

 private:
  std::int32_t first_ns_;
  std::size_t slots_;
  double slot_ns_;
  std::array<Eigen::Matrix4f, kMostSlots> table_;
};

}  // namespace sparsight
