#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/calibration.h"
#include "slam/graph/pose_graph.h"
#include "slam/loop/vocabulary.h"

namespace sparsight {

// A keyframe as LoopCloser knows it, but for its image and cloud: those are in the KeyframeStore,
// under the same number.
struct KnownKeyframe {
  std::uint32_t session = 0;   // 0: the first that the map was made of
  std::uint64_t sequence = 0;  // in its session
  std::size_t submap = 0;      // number of the first keyframe of its sub-map
  CameraIntrinsics camera;     // of the stored image
  Eigen::Isometry3d T_odometry_camera = Eigen::Isometry3d::Identity();  // in its sub-map
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();       // as the graph has it
  BagOfWords bag;
};

// What one session leaves to the next: the keyframes in the order they were added, and what is
// known between them (PoseEdge::from, to: their numbers).
struct KnownPlaces {
  std::vector<KnownKeyframe> keyframes;
  std::vector<PoseEdge> edges;
};

}  // namespace sparsight
