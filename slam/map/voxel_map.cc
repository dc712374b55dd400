#include "slam/map/voxel_map.h"

#include <cmath>

namespace sparsight {
namespace {

// Outside, a coordinate is a mistake, and its voxel's number would not fit an int.
constexpr float kLargestCoordinate_m = 1e6F;

// Multiplicative mixing of the three numbers (Teschner et al. 2003, Sec. 4.1), then the finaliser
// of MurmurHash3, as the slot is taken from the low bits.
std::uint64_t hash_of(const Eigen::Vector3i& voxel) {
  std::uint64_t hash = static_cast<std::uint64_t>(voxel.x()) * 73856093U ^
                       static_cast<std::uint64_t>(voxel.y()) * 19349663U ^
                       static_cast<std::uint64_t>(voxel.z()) * 83492791U;
  hash = (hash ^ (hash >> 33)) * 0xff51afd7ed558ccdU;
  hash = (hash ^ (hash >> 33)) * 0xc4ceb9fe1a85ec53U;
  return hash ^ (hash >> 33);
}

bool better(const MapPoint& a, const MapPoint& b) {
  return a.colored != b.colored ? a.colored : a.range_m < b.range_m;
}

}  // namespace

VoxelMap::VoxelMap(const VoxelMapConfig& config)
    : config_(config), voxel_m_(config.voxel_m), slots_(1024, kEmpty) {}

void VoxelMap::add(const Eigen::Isometry3d& T_world_camera,
                   std::span<const CloudPoint> cloud_camera) {
  const Eigen::Isometry3f T = T_world_camera.cast<float>();
  for (const CloudPoint& seen : cloud_camera) {
    const float range_m = seen.p_camera.norm();
    if (!(range_m <= static_cast<float>(config_.max_range_m))) continue;  // nor NaN
    const Eigen::Vector3f p_world = T * seen.p_camera;
    if (!(p_world.cwiseAbs().maxCoeff() <= kLargestCoordinate_m)) continue;
    insert({p_world, seen.intensity, range_m, seen.rgb, seen.colored});
  }
}

void VoxelMap::insert(const MapPoint& point) {
  std::uint32_t& slot = slots_[slot_of(voxel_of(point))];
  if (slot != kEmpty) {
    if (better(point, points_[slot])) points_[slot] = point;
    return;
  }
  slot = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  if (points_.size() > config_.max_points) {
    coarsen();
  } else if (2 * points_.size() > slots_.size()) {
    rebuild(2 * slots_.size());
  }
}

// Where the voxel's point is, or where it would go.
std::size_t VoxelMap::slot_of(const Eigen::Vector3i& voxel) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(voxel) & mask;
  while (slots_[slot] != kEmpty && voxel_of(points_[slots_[slot]]) != voxel) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

Eigen::Vector3i VoxelMap::voxel_of(const MapPoint& point) const {
  return (point.p_world.cast<double>() / voxel_m_).array().floor().matrix().cast<int>();
}

void VoxelMap::rebuild(std::size_t slots) {
  slots_.assign(slots, kEmpty);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    slots_[slot_of(voxel_of(points_[i]))] = static_cast<std::uint32_t>(i);
  }
}

void VoxelMap::coarsen() {
  std::vector<MapPoint> finer;
  finer.swap(points_);
  voxel_m_ *= 2.0;
  slots_.assign(slots_.size(), kEmpty);
  for (const MapPoint& point : finer) insert(point);
}

}  // namespace sparsight
