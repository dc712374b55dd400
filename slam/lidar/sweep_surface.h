#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "hal/sweep.h"
#include "slam/points/camera_returns.h"

namespace sparsight {

// A return in the LiDAR frame at the exposure.
struct SweepPoint {
  Eigen::Vector3f p_lidar;  // metres
  std::uint16_t ring = 0;
};

// What a keyframe's sweep shows of the world's surface, all around: for each bin of azimuth and
// elevation the plane through the returns in it and around it, where they lie on one. As bins are
// angles, planes are small where things are near. Thread-bound; at() is real-time-safe, and so is a
// copy into one that was used before.
class SweepSurface {
 public:
  struct Plane {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // zero: no plane here
    float thickness_m = 0.0F;                          // rms of the returns about it
    float reach_m = 0.0F;                              // from the centre, along the plane
  };

  SweepSurface() = default;
  explicit SweepSurface(std::span<const SweepPoint> points);

  bool empty() const { return planes_.empty(); }
  // Of the bin that a point falls into; null if there is none.
  const Plane* at(const Eigen::Vector3f& p_lidar) const;

 private:
  std::vector<Plane> planes_;         // row by row
  std::vector<std::int16_t> row_at_;  // by elevation; -1: no ring near
};

// Of a sweep, moved to the exposure; of a dense one every third or so return. `motion` as in
// returns_in_image.
SweepSurface surface_of(const Sweep& sweep, const Eigen::Isometry3d& T_camera_lidar,
                        const MotionAround& motion);

}  // namespace sparsight
