#pragma once

#include "slam/calibration/self_calibration.h"
#include "slam/loop/loop_config.h"
#include "slam/points/point_selection.h"
#include "slam/tracking/tracker.h"
#include "slam/window/window_optimizer.h"

namespace sparsight {

// When a frame becomes a keyframe (Sec. IV-B2, Table I).
struct KeyframeConfig {
  double min_visible_ratio = 0.8;  // gamma_kf: below this share of projectable points
  double max_age_s = 1.0;          // t_kf
};

struct OdometryConfig {
  PointSelectionConfig points;
  PhotometryConfig photometry;
  TrackerConfig tracker;
  KeyframeConfig keyframes;
  WindowConfig window;
  SelfCalibrationConfig self_calibration;
  LoopConfig loop;  // of what follows the odometry; nothing in here depends on it
};

}  // namespace sparsight
