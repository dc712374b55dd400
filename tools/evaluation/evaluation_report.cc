#include "tools/evaluation/evaluation_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace sparsight {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json means_json(const std::vector<SegmentMean>& means, const char* key) {
  Json list = Json::array();
  for (const SegmentMean& mean : means) {
    list.push_back({{key, mean.key},
                    {"segments", mean.segments},
                    {"t_rel_percent", mean.t_rel_percent},
                    {"r_rel_deg_per_m", mean.r_rel_deg_per_m}});
  }
  return list;
}

Json rpe_json(const std::optional<RelativeError>& rpe) {
  if (!rpe) {
    return {
        {"delta_frames", nullptr}, {"translation_rmse_m", nullptr}, {"rotation_rmse_deg", nullptr}};
  }
  return {{"delta_frames", rpe->delta_frames},
          {"translation_rmse_m", rpe->translation_rmse_m},
          {"rotation_rmse_deg", rpe->rotation_rmse_deg}};
}

Json revisits_json(const std::optional<RevisitError>& error) {
  if (!error) {
    return nullptr;
  }
  Json list = Json::array();
  for (const Revisit& revisit : error->revisits) {
    list.push_back({{"place", revisit.place},
                    {"first_frame", revisit.first},
                    {"frame", revisit.again},
                    {"way_m", revisit.way_m},
                    {"error_m", revisit.error_m},
                    {"error_deg", revisit.error_deg}});
  }
  return {{"places", error->places},
          {"rmse_m", error->rmse_m},
          {"max_m", error->max_m},
          {"passes", list}};
}

Json loops_json(const std::optional<LoopEvaluation>& evaluation) {
  if (!evaluation) {
    return nullptr;
  }
  const LoopError& loops = evaluation->loops;
  return {{"standing", loops.loops},
          {"false", loops.false_loops},
          {"max_error_m", loops.max_error_m},
          {"max_error_deg", loops.max_error_deg},
          {"with_earlier_map", loops.with_earlier_map},
          {"keyframes", loops.keyframes},
          {"revisits", loops.revisits},
          {"revisits_closed", loops.closed},
          {"submaps", loops.submaps},
          {"submaps_joined", loops.joined},
          {"submaps_joined_falsely", loops.joined_falsely},
          {"odometry_ate_rmse_m", number_or_null(evaluation->odometry_ate_m)},
          {"ate_rmse_m", number_or_null(evaluation->ate_m)}};
}

void append_loops(std::string& text, const std::optional<LoopEvaluation>& evaluation) {
  if (!evaluation) {
    return;
  }
  const auto out = std::back_inserter(text);
  const LoopError& loops = evaluation->loops;
  fmt::format_to(out,
                 "loops         {} stand, {} of them false   largest error {:.4f} m {:.3f} deg\n",
                 loops.loops, loops.false_loops, loops.max_error_m, loops.max_error_deg);
  if (loops.with_earlier_map > 0) {
    fmt::format_to(out, "              {} more with an earlier map, not judged\n",
                   loops.with_earlier_map);
  }
  fmt::format_to(out, "places        {} of {} keyframes pass one again, {} of them with a loop\n",
                 loops.revisits, loops.keyframes, loops.closed);
  fmt::format_to(out, "sub-maps      {}, {} joined to an earlier one, {} of them falsely\n",
                 loops.submaps, loops.joined, loops.joined_falsely);
  if (evaluation->odometry_ate_m && evaluation->ate_m) {
    fmt::format_to(out, "ATE of parts  sub-maps of odometry {:.4f} m   what loops joined {:.4f}\n",
                   *evaluation->odometry_ate_m, *evaluation->ate_m);
  }
}

void append_revisits(std::string& text, const std::optional<RevisitError>& error) {
  if (!error || error->revisits.empty()) {
    return;
  }
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "revisits      rmse {:.4f} m   max {:.4f}   ({} of {} places)\n",
                 error->rmse_m, error->max_m, error->revisits.size(), error->places);
  fmt::format_to(out, "\n{:>12} {:>9} {:>9} {:>12}\n", "place", "way m", "error m", "error deg");
  for (const Revisit& revisit : error->revisits) {
    fmt::format_to(out, "{:>12} {:>9.1f} {:>9.4f} {:>12.3f}\n", revisit.place, revisit.way_m,
                   revisit.error_m, revisit.error_deg);
  }
}

void append_means(std::string& text, const std::vector<SegmentMean>& means, std::string_view head) {
  if (means.empty()) {
    return;
  }
  fmt::format_to(std::back_inserter(text), "\n{:>12} {:>9} {:>9} {:>12} {:>12}\n", head, "segments",
                 "t_rel %", "r_rel deg/m", "deg/100 m");
  for (const SegmentMean& mean : means) {
    fmt::format_to(std::back_inserter(text), "{:>12g} {:>9} {:>9.3f} {:>12.5f} {:>12.3f}\n",
                   mean.key, mean.segments, mean.t_rel_percent, mean.r_rel_deg_per_m,
                   100.0 * mean.r_rel_deg_per_m);
  }
}

void append_figures(std::string& text, const Evaluation& evaluation) {
  const auto out = std::back_inserter(text);
  const KittiError& kitti = evaluation.kitti;
  if (kitti.t_rel_percent && kitti.r_rel_deg_per_m) {
    fmt::format_to(out, "KITTI error   t_rel {:.3f} %   r_rel {:.5f} deg/m   ({} segments)\n",
                   *kitti.t_rel_percent, *kitti.r_rel_deg_per_m, kitti.segments.size());
  } else {
    fmt::format_to(out, "KITTI error   none: the path holds no segment\n");
  }
  const AbsoluteError& ate = evaluation.ate;
  fmt::format_to(out, "ATE           rmse {:.4f} m   mean {:.4f}   median {:.4f}   max {:.4f}\n",
                 ate.rmse_m, ate.mean_m, ate.median_m, ate.max_m);
  if (evaluation.rpe) {
    fmt::format_to(out, "RPE           {:.5f} m   {:.5f} deg   (rmse over {} frame{})\n",
                   evaluation.rpe->translation_rmse_m, evaluation.rpe->rotation_rmse_deg,
                   evaluation.rpe->delta_frames, evaluation.rpe->delta_frames == 1 ? "" : "s");
  } else {
    fmt::format_to(out, "RPE           none: no two frames so far apart\n");
  }
}

}  // namespace

std::string evaluation_table(const Evaluation& evaluation, const EvaluatedFiles& files) {
  std::string text;
  const auto out = std::back_inserter(text);
  for (const std::string& note : evaluation.notes) {
    fmt::format_to(out, "NOTE: {}\n", note);
  }
  fmt::format_to(out, "estimate      {}\nground truth  {}\n", files.estimate, files.truth);
  fmt::format_to(out, "evaluated     {} of {} frames, {:.1f} m\n", evaluation.frames,
                 evaluation.truth_frames, evaluation.path_length_m);
  append_figures(text, evaluation);
  append_loops(text, evaluation.loops);
  append_revisits(text, evaluation.revisits);
  append_means(text, evaluation.kitti.per_length, "length m");
  append_means(text, evaluation.kitti.per_speed, "speed m/s");
  return text;
}

std::string evaluation_json(const Evaluation& evaluation, const EvaluatedFiles& files) {
  const KittiError& kitti = evaluation.kitti;
  const AbsoluteError& ate = evaluation.ate;
  const Json json = {{"estimate", files.estimate},
                     {"ground_truth", files.truth},
                     {"frames", evaluation.frames},
                     {"estimate_frames", evaluation.estimate_frames},
                     {"ground_truth_frames", evaluation.truth_frames},
                     {"path_length_m", evaluation.path_length_m},
                     {"kitti",
                      {{"t_rel_percent", number_or_null(kitti.t_rel_percent)},
                       {"r_rel_deg_per_m", number_or_null(kitti.r_rel_deg_per_m)},
                       {"segments", kitti.segments.size()},
                       {"lengths", means_json(kitti.per_length, "length_m")},
                       {"speeds", means_json(kitti.per_speed, "speed_m_per_s")}}},
                     {"ate",
                      {{"rmse_m", ate.rmse_m},
                       {"mean_m", ate.mean_m},
                       {"median_m", ate.median_m},
                       {"max_m", ate.max_m}}},
                     {"rpe", rpe_json(evaluation.rpe)},
                     {"revisits", revisits_json(evaluation.revisits)},
                     {"loops", loops_json(evaluation.loops)},
                     {"notes", evaluation.notes}};
  // A file name need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sparsight
