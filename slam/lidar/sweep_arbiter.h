#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "hal/sweep.h"
#include "slam/geometry/se3.h"
#include "slam/lidar/sweep_surface.h"

namespace sparsight {

// What the LiDAR says about where a frame is. It sees all around, and so knows what stands from
// what passes where cars fill the image; but it does not know how far a corridor or a road was
// gone. Asked where the image leaves a doubt, not in its place. Thread-bound; after construction
// real-time-safe.
class SweepArbiter {
 public:
  struct Opinion {
    Eigen::Isometry3d T_keyframe_camera = Eigen::Isometry3d::Identity();
    double share = 0.0;  // see SweepFit
    bool sure = false;   // all six directions are known well
  };

  explicit SweepArbiter(const Eigen::Isometry3d& T_camera_lidar);

  // Takes a sample of the frame's sweep. twist: of the camera, in its frame; T_keyframe_camera:
  // about where it is. The surface must outlive what is asked.
  void hear(const Sweep& sweep, const Vector6d& twist, const SweepSurface& surface,
            const Eigen::Isometry3d& T_keyframe_camera);
  // How much of the sweep lies on the keyframe's surface if the frame is there.
  double share(const Eigen::Isometry3d& T_keyframe_camera) const;
  // The pose near `start` from which most does.
  Opinion opinion(const Eigen::Isometry3d& start) const;

 private:
  Eigen::Isometry3d in_lidar(const Eigen::Isometry3d& T_keyframe_camera) const {
    return T_lidar_camera_ * T_keyframe_camera * T_camera_lidar_;
  }

  Eigen::Isometry3d T_camera_lidar_;
  Eigen::Isometry3d T_lidar_camera_;
  const SweepSurface* surface_ = nullptr;
  bool blurred_ = false;
  std::vector<Eigen::Vector3f> sample_;
};

}  // namespace sparsight
