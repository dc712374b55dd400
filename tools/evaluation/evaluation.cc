#include "tools/evaluation/evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/evaluation/association.h"
#include "tools/evaluation/rigid_alignment.h"
#include "tools/evaluation/rotation_angle.h"

namespace sparsight {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

PosePairs collect_pairs(const Trajectory& estimate, const Trajectory& truth,
                        const std::vector<IndexPair>& indices) {
  PosePairs pairs;
  for (const IndexPair& pair : indices) {
    pairs.estimate.push_back(estimate.poses[pair.estimate]);
    pairs.truth.push_back(truth.poses[pair.truth]);
    if (!truth.times.empty()) {
      pairs.times.push_back(truth.times[pair.truth].time_since_epoch());
    }
  }
  return pairs;
}

std::vector<Eigen::Vector3d> positions(const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(poses.size());
  for (const Eigen::Isometry3d& pose : poses) {
    points.emplace_back(pose.translation());
  }
  return points;
}

double median(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void measure_absolute_error(Evaluation& evaluation, const std::vector<Eigen::Vector3d>& estimate) {
  AbsoluteError& ate = evaluation.ate;
  ate.T_truth_estimate = align_rigidly(evaluation.truth_positions, estimate);
  double squares = 0.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const Eigen::Vector3d aligned = ate.T_truth_estimate * estimate[i];
    const double error = (aligned - evaluation.truth_positions[i]).norm();
    evaluation.aligned_positions.push_back(aligned);
    ate.errors_m.push_back(error);
    squares += error * error;
    ate.mean_m += error;
    ate.max_m = std::max(ate.max_m, error);
  }
  const auto count = static_cast<double>(estimate.size());
  ate.rmse_m = std::sqrt(squares / count);
  ate.mean_m /= count;
  ate.median_m = median(ate.errors_m);
}

std::optional<RelativeError> relative_error(const PosePairs& pairs, std::size_t delta) {
  if (pairs.truth.size() <= delta) {
    return std::nullopt;
  }
  double translation_squares = 0.0;
  double rotation_squares = 0.0;
  for (std::size_t i = 0; i + delta < pairs.truth.size(); ++i) {
    const Eigen::Isometry3d motion_truth = pairs.truth[i].inverse() * pairs.truth[i + delta];
    const Eigen::Isometry3d motion_estimate =
        pairs.estimate[i].inverse() * pairs.estimate[i + delta];
    const Eigen::Isometry3d error = motion_truth.inverse() * motion_estimate;
    translation_squares += error.translation().squaredNorm();
    rotation_squares += std::pow(rotation_angle_rad(error.linear()), 2);
  }
  const auto count = static_cast<double>(pairs.truth.size() - delta);
  return RelativeError{.delta_frames = delta,
                       .translation_rmse_m = std::sqrt(translation_squares / count),
                       .rotation_rmse_deg = std::sqrt(rotation_squares / count) * kDegPerRad};
}

void note_what_is_missing(Evaluation& evaluation, bool by_time, const EvaluationOptions& options) {
  auto& notes = evaluation.notes;
  if (by_time && evaluation.frames < evaluation.estimate_frames) {
    notes.push_back(fmt::format(
        "only {} of the estimate's {} poses have ground truth within {} s; the others are not "
        "evaluated",
        evaluation.frames, evaluation.estimate_frames, to_seconds(options.max_time_difference)));
  } else if (!by_time && evaluation.estimate_frames < evaluation.truth_frames) {
    notes.push_back(fmt::format(
        "the estimate has {} poses, the ground truth {}: only the first {} are evaluated",
        evaluation.estimate_frames, evaluation.truth_frames, evaluation.frames));
  } else if (!by_time && evaluation.estimate_frames > evaluation.truth_frames) {
    notes.push_back(fmt::format(
        "the ground truth has {} poses, the estimate {}: only the first {} are evaluated; is it "
        "the ground truth of this sequence?",
        evaluation.truth_frames, evaluation.estimate_frames, evaluation.frames));
  }
  if (evaluation.revisits && evaluation.revisits->revisits.empty()) {
    notes.push_back("the true path does not come back to its start: no place is passed twice");
  }
  if (!evaluation.kitti.t_rel_percent && !options.segments.lengths_m.empty()) {
    notes.push_back(fmt::format(
        "the path is {:.1f} m long: too short for any segment, the shortest is {:g} m "
        "(--lengths 10,20,30,40,50 for short drives)",
        evaluation.path_length_m, *std::ranges::min_element(options.segments.lengths_m)));
  }
}

}  // namespace

Result<Evaluation> evaluate_trajectories(const Trajectory& estimate, const Trajectory& truth,
                                         const EvaluationOptions& options) {
  const auto indices = associate(estimate, truth, options.max_time_difference);
  if (!indices) {
    return tl::unexpected(indices.error());
  }
  const PosePairs pairs =
      collect_pairs(with_exact_rotations(estimate), with_exact_rotations(truth), *indices);
  Evaluation evaluation{.frames = indices->size(),
                        .estimate_frames = estimate.poses.size(),
                        .truth_frames = truth.poses.size(),
                        .path_length_m = path_distances_m(pairs.truth).back(),
                        .kitti = kitti_error(pairs, options.segments),
                        .rpe = relative_error(pairs, options.rpe_delta_frames)};
  if (options.revisits.places > 0) evaluation.revisits = revisit_error(pairs, options.revisits);
  for (const IndexPair& pair : *indices) {
    evaluation.estimate_indices.push_back(pair.estimate);
  }
  evaluation.truth_positions = positions(pairs.truth);
  measure_absolute_error(evaluation, positions(pairs.estimate));
  note_what_is_missing(evaluation, !estimate.times.empty(), options);
  return evaluation;
}

}  // namespace sparsight
