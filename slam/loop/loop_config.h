#pragma once

namespace sparsight {

// When two views are of the same place. Metres and degrees, one set for all data.
struct LoopVerificationConfig {
  int min_pose_inliers = 25;         // ORB matches that the starting pose explains
  double max_reprojection_px = 2.0;  // of such a match
  double max_disagreement_m = 0.03;  // between the two directions
  double max_disagreement_deg = 0.3;
  double max_from_start_m = 0.5;  // direct alignment refines the starting pose, no more
  double max_from_start_deg = 3.0;
  double min_overlap = 0.4;      // of the points, in both directions
  double min_found_share = 0.6;  // of the visible patches, in both directions
  int min_points = 100;          // visible patches
};

// When loops join two sub-maps that nothing connected: there is no odometry between them that could
// contradict a look-alike, so that sight has to be surer, and more than one view say the same.
struct SubmapJoinConfig {
  int min_loops = 2;  // that agree; and so many more than those that say otherwise
  // Two of them are of views so far apart, in metres or in degrees: the same door seen twice is one
  // piece of evidence.
  double min_apart_m = 1.0;
  double min_apart_deg = 30.0;
  double max_disagreement_m = 0.1;  // between two loops, and a share of the way between them
  double max_disagreement_share = 0.02;
  double max_disagreement_deg = 1.0;
  int min_pose_inliers = 30;  // of each loop, as in LoopVerificationConfig
  double min_found_share = 0.7;
};

// Loop closure, Sec. IV-E.
struct LoopConfig {
  bool enabled = true;
  int image_level =
      1;  // of the pyramid: places are recognised and verified in images halved so often
  int features = 800;          // ORB features per keyframe
  int neighbours = 3;          // keyframes on either side whose depth is integrated
  int recent_keyframes = 30;   // those just passed are no loop
  int consistent_queries = 2;  // keyframes in a row that must recognise nearly the same place
  int checks_per_keyframe = 2;
  double dcs_phi = 12.6;  // of Dynamic Covariance Scaling
  // What odometry's information does not know, per step between keyframes: calibration, timing.
  double odometry_floor_deg = 0.05;
  double odometry_floor_m = 0.005;
  double odometry_floor_share = 0.01;  // of the step's length
  LoopVerificationConfig verification;
  SubmapJoinConfig join;
};

}  // namespace sparsight
