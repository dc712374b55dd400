#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "slam/image/pyramid.h"
#include "slam/tracking/motion_model.h"
#include "slam/tracking/tracker.h"

namespace sparsight {

// What became of one frame. A frame that could not be tracked says so: for a moment its pose is
// predicted, then it has none.
struct FrameOutcome {
  enum class Status : std::uint8_t {
    kTracked,    // pose measured against a keyframe
    kFirst,      // defines the world frame
    kPredicted,  // not measured: no image, or tracking failed from every start
    kLost,       // in question for so long that the pose says nothing
  };
  Status status = Status::kPredicted;
  TrackingResult tracking;  // of the best attempt; its pose is the predicted one if none
  std::uint64_t keyframe_sequence = 0;  // the keyframe T_keyframe_camera refers to
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  // as known at that moment
  // Missed, or so little was found, and suddenly, that it may be a look-alike: if frames in
  // question end in a lost one, none of them had a pose.
  bool in_question = false;
  bool becomes_keyframe = false;  // of a lost frame: the first of a new sub-map
  std::uint32_t submap = 0;  // that the keyframe belongs to: poses of one say nothing of another
};

// What tracking leaves behind of a frame, and all that the window needs if it becomes a keyframe.
// Keeps its memory from frame to frame.
struct TrackedFrame {
  ImagePyramid pyramid;  // empty: no image
  FrameOutcome outcome;
  MotionModel motion;  // as of this frame, in the keyframe it was tracked against
};

}  // namespace sparsight
