#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <deque>
#include <vector>

#include "hal/calibration.h"
#include "slam/keyframe.h"
#include "slam/map/voxel_map.h"

namespace sparsight {

// A keyframe where the map has it.
struct PosedCloud {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  CameraIntrinsics camera;  // of whatever size
  std::vector<CloudPoint> cloud_camera;
};

// Puts the clouds of keyframes into a voxel map, in the order they were taken. The beams of one
// scan leave gaps through which a point behind would take the colour of what hides it: so a point
// keeps its colour only if what the keyframes just before and after measured does not hide it
// either. One that loses it is still a point, and another keyframe may know its colour.
// Thread-bound.
class MapComposer {
 public:
  explicit MapComposer(VoxelMap& map) : map_(map) {}

  void add(PosedCloud keyframe);
  // At the end: those that waited for the ones after them.
  void finish();

 private:
  void put(std::size_t index);

  VoxelMap& map_;
  std::deque<PosedCloud> nearby_;
  std::size_t next_ = 0;  // of nearby_, to be put into the map
};

}  // namespace sparsight
