#include "tools/benchmark/run_figures.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tools/evaluation/text_file.h"

namespace sparsight {
namespace {

const std::vector<double> kShortLengths_m = {10, 20, 30, 40, 50};

std::optional<double> number_at(const nlohmann::json& json, const std::string& pointer) {
  const nlohmann::json::json_pointer place(pointer);
  return json.contains(place) && json.at(place).is_number()
             ? std::optional(json.at(place).get<double>())
             : std::nullopt;
}

Result<RunAccuracy> measure_accuracy(const Trajectory& estimate,
                                     const std::filesystem::path& truth_file) {
  const Result<Trajectory> truth = read_trajectory(truth_file, TrajectoryFormat::kKitti);
  if (!truth) return tl::unexpected(truth.error());
  EvaluationOptions options;
  auto evaluation = evaluate_trajectories(estimate, *truth, options);
  const bool too_short = evaluation && !evaluation->kitti.t_rel_percent;
  if (too_short) {
    options.segments.lengths_m = kShortLengths_m;
    evaluation = evaluate_trajectories(estimate, *truth, options);
  }
  return std::move(evaluation).map([&](Evaluation&& result) {
    return RunAccuracy{std::move(result), options.segments.lengths_m, too_short};
  });
}

}  // namespace

Result<RunFigures> read_run_figures(const ReplayRun& run) {
  const auto estimate = read_trajectory(run.session / "trajectory.kitti", TrajectoryFormat::kKitti);
  if (!estimate) return tl::unexpected(estimate.error());
  const auto text = read_text_file(run.session / "session.json");
  if (!text) return tl::unexpected(text.error());
  const auto session = nlohmann::json::parse(*text, nullptr, false);
  RunFigures figures{.frames = estimate->poses.size(),
                     .tracking_median_ms = number_at(session, "/tracking_ms/median"),
                     .tracking_p99_ms = number_at(session, "/tracking_ms/p99"),
                     .times_real_time = number_at(session, "/times_real_time")};
  if (run.sequence.truth) {
    auto accuracy = measure_accuracy(*estimate, *run.sequence.truth);
    if (!accuracy) return tl::unexpected(accuracy.error());
    figures.accuracy = *std::move(accuracy);
  }
  return figures;
}

}  // namespace sparsight
