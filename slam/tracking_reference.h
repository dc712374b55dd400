#pragma once

#include <cstdint>
#include <optional>

#include "slam/geometry/camera_model.h"
#include "slam/tracking/tracking_target.h"

namespace sparsight {

// The window's word to tracking: the keyframe to track against, posed as well as it is known, and
// the camera to look through. A copy of its own, so that the two stages share nothing; copied into
// one that was used before, it allocates nothing.
struct TrackingReference {
  TrackingTarget keyframe;
  CameraModel camera{CameraIntrinsics{}};
  int keyframes = 0;         // in the window; 0: there is none yet to track against
  std::uint32_t submap = 0;  // of the keyframe; counts from 0
  // The frame last handed over as a keyframe, whether or not it was taken.
  std::optional<std::uint64_t> considered;
  std::uint64_t version = 0;  // counts what was published
};

}  // namespace sparsight
