#pragma once

#include "slam/odometry.h"
#include "tools/configuration/field_range.h"

namespace sparsight {

// The configuration as files see it: a table per struct, a key per field, nested as the modules
// nest. A field that is missing here cannot be configured; a test counts them. A Visitor has
//   field(key, number, range), field(key, bool), choice(key, enumerator, names), table(key,
//   struct).

template <typename Visitor>
void visit_fields(Visitor& profile, PointSelectionConfig& points) {
  profile.field("bin_deg", points.bin_deg, {0.05, 45.0});
  profile.field("min_depth_m", points.min_depth_m, {0.0, 100.0});
  profile.field("max_depth_m", points.max_depth_m, {1.0, 1000.0});
  profile.field("reject_depth_edges", points.reject_depth_edges);
  profile.field("reject_hidden", points.reject_hidden);
  profile.field("surface_slope", points.surface_slope);
}

template <typename Visitor>
void visit_fields(Visitor& profile, PhotometryConfig& photometry) {
  profile.field("student_t_dof", photometry.student_t_dof, {0.1, 1000.0});
  profile.field("gradient_weight_constant", photometry.gradient_weight_constant, {0.0, 1000.0});
  profile.field("affine_brightness", photometry.affine_brightness);
  profile.field("patch_weights", photometry.patch_weights);
  profile.field("weigh_down_strangers", photometry.weigh_down_strangers);
  profile.field("weigh_down_rough", photometry.weigh_down_rough);
}

template <typename Visitor>
void visit_fields(Visitor& profile, AlignmentConfig& alignment) {
  profile.field("max_iterations", alignment.max_iterations, {1, 1000});
  profile.field("convergence_px", alignment.convergence_px, {1e-6, 10.0});
}

template <typename Visitor>
void visit_fields(Visitor& profile, TrackerConfig& tracker) {
  profile.field("pyramid_levels", tracker.pyramid_levels, {1, 10});
  profile.table("alignment", tracker.alignment);
  profile.field("automatic_top_level", tracker.automatic_top_level);
  profile.field("scan_speed", tracker.scan_speed);
  profile.field("sweep_arbiter", tracker.sweep_arbiter);
  profile.field("try_other_starts", tracker.try_other_starts);
  profile.field("min_points", tracker.min_points, {6, 100000});
  profile.field("min_found_share", tracker.min_found_share, {-1.0, 1.0});
  profile.field("max_acceleration_m_s2", tracker.max_acceleration_m_s2, {1.0, 1e6});
}

template <typename Visitor>
void visit_fields(Visitor& profile, KeyframeConfig& keyframes) {
  profile.field("min_visible_ratio", keyframes.min_visible_ratio, kShare);
  profile.field("max_age_s", keyframes.max_age_s, {0.0, 3600.0});
}

template <typename Visitor>
void visit_fields(Visitor& profile, WindowConfig& window) {
  profile.field("size", window.size, {2, 50});
  profile.field("max_iterations", window.max_iterations, {0, 1000});
  profile.field("convergence_px", window.convergence_px, {1e-6, 10.0});
  profile.field("relinearization_px", window.relinearization_px, {0.0, 10.0});
  profile.field("min_visible_ratio", window.min_visible_ratio, kShare);
  profile.field("min_points", window.min_points, {6, 100000});
  profile.field("min_found_share", window.min_found_share, {-1.0, 1.0});
}

template <typename Visitor>
void visit_fields(Visitor& profile, SelfCalibrationConfig& calibration) {
  profile.field("enabled", calibration.enabled);
  profile.field("focal_sigma", calibration.focal_sigma, {1e-6, 1.0});
  profile.field("k1_sigma", calibration.k1_sigma, {1e-6, 1.0});
  profile.field("believed_share", calibration.believed_share, {1e-9, 1.0});
}

template <typename Visitor>
void visit_fields(Visitor& profile, LoopVerificationConfig& verification) {
  profile.field("min_pose_inliers", verification.min_pose_inliers, {6, 10000});
  profile.field("max_reprojection_px", verification.max_reprojection_px, {0.1, 100.0});
  profile.field("max_disagreement_m", verification.max_disagreement_m, {1e-6, 10.0});
  profile.field("max_disagreement_deg", verification.max_disagreement_deg, {1e-6, 90.0});
  profile.field("max_from_start_m", verification.max_from_start_m, {1e-6, 100.0});
  profile.field("max_from_start_deg", verification.max_from_start_deg, {1e-6, 180.0});
  profile.field("min_overlap", verification.min_overlap, kShare);
  profile.field("min_found_share", verification.min_found_share, kShare);
  profile.field("min_points", verification.min_points, {6, 100000});
}

template <typename Visitor>
void visit_fields(Visitor& profile, SubmapJoinConfig& join) {
  profile.field("min_loops", join.min_loops, {2, 100});
  profile.field("min_apart_m", join.min_apart_m, {0.0, 100.0});
  profile.field("min_apart_deg", join.min_apart_deg, {0.0, 180.0});
  profile.field("max_disagreement_m", join.max_disagreement_m, {1e-6, 10.0});
  profile.field("max_disagreement_share", join.max_disagreement_share, kShare);
  profile.field("max_disagreement_deg", join.max_disagreement_deg, {1e-6, 90.0});
  profile.field("min_pose_inliers", join.min_pose_inliers, {6, 10000});
  profile.field("min_found_share", join.min_found_share, kShare);
}

template <typename Visitor>
void visit_fields(Visitor& profile, LoopConfig& loop) {
  profile.field("enabled", loop.enabled);
  profile.field("image_level", loop.image_level, {0, 4});
  profile.field("features", loop.features, {50, 10000});
  profile.field("neighbours", loop.neighbours, {0, 20});
  profile.field("recent_keyframes", loop.recent_keyframes, {1, 100000});
  profile.field("consistent_queries", loop.consistent_queries, {1, 20});
  profile.field("checks_per_keyframe", loop.checks_per_keyframe, {1, 100});
  profile.field("dcs_phi", loop.dcs_phi, {1e-3, 1e6});
  profile.field("odometry_floor_deg", loop.odometry_floor_deg, {1e-6, 10.0});
  profile.field("odometry_floor_m", loop.odometry_floor_m, {1e-6, 10.0});
  profile.field("odometry_floor_share", loop.odometry_floor_share, kShare);
  profile.table("verification", loop.verification);
  profile.table("join", loop.join);
}

template <typename Visitor>
void visit_fields(Visitor& profile, OdometryConfig& odometry) {
  profile.table("points", odometry.points);
  profile.table("photometry", odometry.photometry);
  profile.table("tracker", odometry.tracker);
  profile.table("keyframes", odometry.keyframes);
  profile.table("window", odometry.window);
  profile.table("self_calibration", odometry.self_calibration);
  profile.table("loop", odometry.loop);
}

}  // namespace sparsight
