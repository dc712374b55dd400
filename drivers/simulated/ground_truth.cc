#include "drivers/simulated/ground_truth.h"

#include <fmt/format.h>

#include <fstream>
#include <utility>

#include "drivers/simulated/walk.h"

namespace sparsight {

SimulatedTruth::SimulatedTruth(std::shared_ptr<const simulated::Walk> walk, HostTime start,
                               const Eigen::Isometry3d& T_camera_lidar,
                               std::vector<HostTime> exposures)
    : walk_(std::move(walk)),
      start_(start),
      T_lidar_camera_(T_camera_lidar.inverse()),
      exposures_(std::move(exposures)) {}

Eigen::Isometry3d SimulatedTruth::lidar_pose(HostTime at) const {
  return walk_->lidar_pose(to_seconds(at - start_));
}

Eigen::Isometry3d SimulatedTruth::camera_pose(HostTime at) const {
  return lidar_pose(at) * T_lidar_camera_;
}

std::string SimulatedTruth::tum() const {
  std::string text;
  for (const HostTime& at : exposures_) {
    const Eigen::Isometry3d T_world_camera = camera_pose(at);
    const Eigen::Vector3d p = T_world_camera.translation();
    const Eigen::Quaterniond q(T_world_camera.linear());
    const std::int64_t ns = at.time_since_epoch().count();
    text += fmt::format("{}.{:09} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                        ns / 1'000'000'000, ns % 1'000'000'000, p.x(), p.y(), p.z(), q.x(), q.y(),
                        q.z(), q.w());
  }
  return text;
}

Result<void> SimulatedTruth::write_tum(const std::string& path) const {
  std::ofstream file(path, std::ios::binary);
  file << tum();
  file.flush();
  if (!file) {
    return fail(ErrorCode::kUnreadable,
                path + ": cannot be written; is the folder there, and is there space?");
  }
  return {};
}

}  // namespace sparsight
