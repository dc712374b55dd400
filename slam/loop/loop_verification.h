#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "slam/geometry/se3.h"
#include "slam/keyframe.h"
#include "slam/loop/loop_config.h"
#include "slam/loop/orb_features.h"
#include "slam/points/camera_returns.h"
#include "slam/points/point_selection.h"
#include "slam/tracking/tracker.h"

namespace sparsight {

// A keyframe with the depth of its neighbours.
struct LoopView {
  GreyImage image;
  std::vector<CameraReturn> returns;
  OrbFeatures features;
};

struct LoopCheck {
  enum class Verdict : std::uint8_t {
    kAccepted,
    kFewMatches,    // no starting pose
    kNotAligned,    // one direction failed
    kDisagreement,  // the two directions, or they and the start, differ
    kLittleOverlap,
    kLittleFound,
  };
  Verdict verdict = Verdict::kFewMatches;
  Eigen::Isometry3d T_current_candidate = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Zero();  // left perturbation of T_current_candidate
  int pose_inliers = 0;
  double disagreement_m = 0.0;
  double disagreement_deg = 0.0;
  double overlap = 0.0;      // the smaller of the two
  double found_share = 0.0;  // likewise
};

// As session.json names it.
const char* name_of(LoopCheck::Verdict verdict);

// Sec. IV-E: T_c^n and T_n^c are found independently, each with the depth of its own view, from the
// same start; the loop stands only if they agree. Unlike in the paper the start is a pose from ORB
// matches, so that views from different sides converge. Thread-bound, deterministic.
class LoopVerifier {
 public:
  LoopVerifier(const CameraModel& camera, const LoopVerificationConfig& config,
               const PointSelectionConfig& points, const TrackerConfig& tracker,
               const PhotometryConfig& photometry);

  LoopCheck check(const LoopView& current, const LoopView& candidate);

 private:
  struct Start {
    Eigen::Isometry3d T_current_candidate = Eigen::Isometry3d::Identity();
    int inliers = 0;
  };
  Start start_from_matches(const LoopView& current, const LoopView& candidate) const;
  TrackingResult align(const Keyframe& host, const Keyframe& target,
                       const Eigen::Isometry3d& start_T_host_target);
  Keyframe keyframe_of(const LoopView& view) const;

  CameraModel camera_;
  LoopVerificationConfig config_;
  PointSelectionConfig points_;
  TrackerConfig tracker_config_;
  PhotometryConfig photometry_;
  Tracker tracker_;
};

}  // namespace sparsight
