#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

namespace simulated {
class Walk;
}

// Where the simulated rig really was. Thread-safe.
class SimulatedTruth {
 public:
  SimulatedTruth(std::shared_ptr<const simulated::Walk> walk, HostTime start,
                 const Eigen::Isometry3d& T_camera_lidar, std::vector<HostTime> exposures);

  Eigen::Isometry3d lidar_pose(HostTime at) const;   // T_world_lidar
  Eigen::Isometry3d camera_pose(HostTime at) const;  // T_world_camera
  // Middle of every exposure, also of frames that a fault takes away.
  const std::vector<HostTime>& exposures() const { return exposures_; }

  // Camera poses at the exposures, a line each: t x y z qx qy qz qw.
  std::string tum() const;
  Result<void> write_tum(const std::string& path) const;

 private:
  std::shared_ptr<const simulated::Walk> walk_;
  HostTime start_;
  Eigen::Isometry3d T_lidar_camera_;
  std::vector<HostTime> exposures_;
};

}  // namespace sparsight
