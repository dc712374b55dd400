#include <nlohmann/json.hpp>

#include "tools/session/session_summary.h"

namespace sparsight {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const RigCalibration& calibration) {
  const CameraIntrinsics& camera = calibration.camera;
  Json T_camera_lidar = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      T_camera_lidar.push_back(calibration.T_camera_lidar(row, column));
    }
  }
  return {{"width", camera.width},
          {"height", camera.height},
          {"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"distortion_k1_k2_p1_p2_k3", {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3}},
          {"T_camera_lidar_3x4_row_major", T_camera_lidar}};
}

Json json_of(const StageTiming& timing) {
  return {{"calls", timing.calls},
          {"median", timing.median_ms},
          {"p99", timing.p99_ms},
          {"max", timing.max_ms}};
}

Json json_of(const StageTimes& times) {
  return {{"median", times.median_ms}, {"p99", times.p99_ms}, {"max", times.max_ms}};
}

template <typename Figure>
Json json_of(const std::optional<Figure>& figure) {
  return figure ? Json(*figure) : Json(nullptr);
}

Json json_of(const LiveFigures& live) {
  return {{"exposure_to_pose_ms", json_of(live.exposure_to_pose)},
          {"arrival_to_pose_ms", json_of(live.arrival_to_pose)},
          {"wake_up_ms", json_of(live.wake_up)},
          {"deadlines_missed", live.deadlines_missed},
          {"frames_dropped", live.frames_dropped},
          {"events_unrecorded", live.events_unrecorded},
          {"work_left_out", live.work_left_out},
          {"first_pose_s", json_of(live.first_pose_s)},
          {"cpu_share", live.cpu_share},
          {"resident_bytes", live.resident_bytes}};
}

Json json_of(const GroundTruth& truth) {
  const Evaluation& evaluation = truth.evaluation;
  Json accuracy = {{"ground_truth", truth.file.string()},
                   {"frames", evaluation.frames},
                   {"path_length_m", evaluation.path_length_m},
                   {"t_rel_percent", json_of(evaluation.kitti.t_rel_percent)},
                   {"r_rel_deg_per_m", json_of(evaluation.kitti.r_rel_deg_per_m)},
                   {"ate_rmse_m", evaluation.ate.rmse_m},
                   {"ate_max_m", evaluation.ate.max_m},
                   {"notes", evaluation.notes}};
  for (const SegmentMean& mean : evaluation.kitti.per_length) {
    accuracy["per_length"].push_back({{"length_m", mean.key},
                                      {"segments", mean.segments},
                                      {"t_rel_percent", mean.t_rel_percent},
                                      {"r_rel_deg_per_m", mean.r_rel_deg_per_m}});
  }
  return accuracy;
}

Json json_of(const LoopStatistics& statistics) {
  Json json = {{"keyframes", statistics.keyframes},
               {"queries_with_similar", statistics.queries},
               {"candidates", statistics.candidates}};
  for (const auto& [verdict, count] : statistics.verdicts) json[name_of(verdict)] = count;
  json["contradicted_by_graph"] = statistics.contradicted;
  json["submaps_joined"] = statistics.submaps_joined;
  json["joins_revised"] = statistics.joins_revised;
  return json;
}

// Frames without a pose: trajectory.tum has no line for them, trajectory.kitti that of the frame
// before.
Json json_of(const std::vector<Gap>& gaps) {
  Json list = Json::array();
  for (const Gap& gap : gaps) {
    list.push_back(
        {{"first_frame", gap.first}, {"last_frame", gap.last}, {"seconds", gap.seconds}});
  }
  return list;
}

// Those of one "part" stand where odometry and loops have them; how parts stand to each other is a
// guess.
Json json_of(const std::vector<Submap>& submaps) {
  Json list = Json::array();
  for (const Submap& submap : submaps) {
    list.push_back({{"first_frame", submap.first_keyframe},
                    {"keyframes", submap.keyframes},
                    {"part", submap.part}});
  }
  return list;
}

Json json_of(const std::vector<LoopClosure>& loops) {
  Json list = Json::array();
  for (const LoopClosure& loop : loops) {
    const Eigen::Vector3d t = loop.check.T_current_candidate.translation();
    const Eigen::Quaterniond q(loop.check.T_current_candidate.linear());
    list.push_back(
        {{"frame", loop.current},
         {"seen_before_in_frame", loop.candidate},
         {"in_earlier_map", loop.in_earlier_map},
         {"T_frame_before_tx_ty_tz_qx_qy_qz_qw", {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}},
         {"distance_m", t.norm()},
         {"pose_inliers", loop.check.pose_inliers},
         {"disagreement_m", loop.check.disagreement_m},
         {"disagreement_deg", loop.check.disagreement_deg},
         {"overlap", loop.check.overlap},
         {"found_share", loop.check.found_share}});
  }
  return list;
}

}  // namespace

std::string session_json(const Session& session, const SessionSummary& summary) {
  const SessionDescription& description = session.description;
  Json json = {{"sparsight", SPARSIGHT_VERSION},
               {"complete", session.complete},
               {"broke_off", json_of(session.broke_off)},
               {"source", description.source.string()},
               {"profile", description.profile_name},
               {"rays", json_of(description.rays)},
               {"camera", description.camera},
               {"calibration", json_of(description.calibration)},
               {"frames", summary.frames},
               {"tracked", summary.tracked},
               {"predicted", summary.predicted},
               {"lost", summary.lost},
               {"gaps", json_of(gaps_of(session.trajectory))},
               {"submaps", json_of(session.submaps)},
               {"keyframes", summary.keyframes},
               {"map_points", session.map_points},
               {"recorded_s", summary.recorded_s},
               {"path_length_m", summary.path_length_m},
               {"faults", session.faults.count_by_kind()},
               {"tracking_ms", json_of(summary.tracking)},
               {"window_ms", json_of(summary.window)},
               {"loops", json_of(session.loops)},
               {"loop_search", json_of(session.loop_statistics)},
               {"wall_s", to_seconds(session.wall_time)},
               {"frames_per_s", summary.frames_per_s},
               {"times_real_time", summary.realtime_factor},
               {"accuracy", session.truth ? json_of(*session.truth) : Json(nullptr)},
               {"notes", session.notes}};
  if (session.live) json["live"] = json_of(*session.live);
  // A path need not be UTF-8; an unreadable character must not cost the session.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sparsight
