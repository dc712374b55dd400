#include "slam/odometry.h"

namespace sparsight {

Odometry::Odometry(const RigCalibration& calibration, const OdometryConfig& config)
    : tracking_(calibration, config), window_(calibration, config) {}

FrameOutcome Odometry::track(const SynchronizedFrame& frame) {
  tracking_.track(frame, reference_, tracked_);
  return tracked_.outcome;
}

void Odometry::add_keyframe(const SynchronizedFrame& frame) {
  if (window_.accept(frame, tracked_)) window_.optimize();
  window_.describe(reference_);
}

}  // namespace sparsight
