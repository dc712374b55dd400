#pragma once

#include <string>

#include "tools/evaluation/evaluation.h"

namespace sparsight {

// What was compared, for the head of the report.
struct EvaluatedFiles {
  std::string estimate;
  std::string truth;
};

// For people: notes first, then a line per figure and a table per segment length.
std::string evaluation_table(const Evaluation& evaluation, const EvaluatedFiles& files);

// For machines. The keys are stable; a figure that could not be computed is null:
//   estimate, ground_truth, frames, estimate_frames, ground_truth_frames, path_length_m, notes
//   [text] kitti { t_rel_percent, r_rel_deg_per_m, segments,
//           lengths [{ length_m, segments, t_rel_percent, r_rel_deg_per_m }],
//           speeds [{ speed_m_per_s, segments, t_rel_percent, r_rel_deg_per_m }] }
//   ate { rmse_m, mean_m, median_m, max_m }
//   rpe { delta_frames, translation_rmse_m, rotation_rmse_deg }
//   revisits { places, rmse_m, max_m, passes [{ place, first_frame, frame, way_m, error_m,
//           error_deg }] }
//   loops { standing, false, max_error_m, max_error_deg, with_earlier_map, keyframes, revisits,
//           revisits_closed, submaps, submaps_joined, submaps_joined_falsely,
//           odometry_ate_rmse_m, ate_rmse_m }
std::string evaluation_json(const Evaluation& evaluation, const EvaluatedFiles& files);

}  // namespace sparsight
