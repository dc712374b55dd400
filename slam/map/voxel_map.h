#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/keyframe.h"

namespace sparsight {

struct VoxelMapConfig {
  double voxel_m = 0.1;                // edge; surfaces nearer than this to each other merge
  double max_range_m = 60.0;           // farther returns are seen again, better, from nearer
  std::size_t max_points = 8'000'000;  // beyond, the voxels' edge doubles: 24 + 8 ... 16 bytes each
};

struct MapPoint {
  Eigen::Vector3f p_world = Eigen::Vector3f::Zero();  // metres
  float intensity = 0.0F;                             // as the LiDAR gave it
  float range_m = 0.0F;                               // from the camera that saw it
  std::array<std::uint8_t, 3> rgb{};
  bool colored = true;  // false: hidden from the camera that was there; rgb is black
};

// The clouds of keyframes in the world, each place once: of all returns in a voxel one stays, as it
// was measured. Those with a colour of their own go before those without, then the one seen from
// nearest, as its position and its colour are the best. Thread-bound.
class VoxelMap {
 public:
  explicit VoxelMap(const VoxelMapConfig& config);

  void add(const Eigen::Isometry3d& T_world_camera, std::span<const CloudPoint> cloud_camera);

  // In the order in which their voxels were first seen.
  const std::vector<MapPoint>& points() const { return points_; }
  double voxel_m() const { return voxel_m_; }  // as it is now

 private:
  // Number of a voxel's point in points_, in an open hash table: a point's position names its
  // voxel, so no key is stored.
  static constexpr std::uint32_t kEmpty = UINT32_MAX;

  void insert(const MapPoint& point);
  std::size_t slot_of(const Eigen::Vector3i& voxel) const;
  Eigen::Vector3i voxel_of(const MapPoint& point) const;
  void rebuild(std::size_t slots);
  void coarsen();

  VoxelMapConfig config_;
  double voxel_m_;
  std::vector<MapPoint> points_;
  std::vector<std::uint32_t> slots_;  // a power of two, at most half full
};

}  // namespace sparsight
