#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hal/result.h"
#include "tools/evaluation/association.h"
#include "tools/evaluation/kitti_error.h"
#include "tools/evaluation/loop_evaluation.h"
#include "tools/evaluation/revisit_error.h"
#include "tools/evaluation/trajectory.h"

namespace sparsight {

struct EvaluationOptions {
  SegmentOptions segments;
  std::size_t rpe_delta_frames = 1;
  RevisitOptions revisits;
  std::chrono::nanoseconds max_time_difference = kSimultaneous;
};

// Distance between true and estimated positions once the estimate is moved rigidly onto the truth.
struct AbsoluteError {
  double rmse_m = 0.0;
  double mean_m = 0.0;
  double median_m = 0.0;
  double max_m = 0.0;
  Eigen::Isometry3d T_truth_estimate = Eigen::Isometry3d::Identity();
  std::vector<double> errors_m;  // per evaluated frame
};

// Error of the motion over a fixed number of frames.
struct RelativeError {
  std::size_t delta_frames = 1;
  double translation_rmse_m = 0.0;
  double rotation_rmse_deg = 0.0;
};

struct Evaluation {
  std::size_t frames = 0;           // evaluated: poses with a partner in the other file
  std::size_t estimate_frames = 0;  // in the file
  std::size_t truth_frames = 0;
  double path_length_m = 0.0;  // along the ground truth of the evaluated frames
  KittiError kitti;
  AbsoluteError ate;
  std::optional<RelativeError> rpe;      // none: no two frames that far apart
  std::optional<RevisitError> revisits;  // none: not asked for
  std::optional<LoopEvaluation> loops;   // likewise
  // Per evaluated frame, in the ground truth's world.
  std::vector<std::size_t> estimate_indices;
  std::vector<Eigen::Vector3d> truth_positions;
  std::vector<Eigen::Vector3d> aligned_positions;  // of the estimate, after T_truth_estimate
  std::vector<std::string> notes;  // what a person must know before trusting the figures
};

// Frames are paired by time if both have times, by index if neither has. Fails if only one has, or
// if no frame finds a partner.
Result<Evaluation> evaluate_trajectories(const Trajectory& estimate, const Trajectory& truth,
                                         const EvaluationOptions& options);

}  // namespace sparsight
