#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tools/session/chart_axis.h"
#include "tools/session/report_charts.h"

namespace sparsight {
namespace {

using Kind = ChartSeries::Kind;
using Curve = std::vector<Eigen::Vector2d>;
using Positions = std::vector<Eigen::Vector3d>;

Positions positions_of(const std::vector<TrajectoryPose>& trajectory) {
  Positions positions;
  for (const TrajectoryPose& pose : trajectory) {
    if (pose.known) positions.emplace_back(pose.T_world_camera.translation());
  }
  return positions;
}

Positions positions_at(const Session& session, const std::vector<std::uint64_t>& sequences) {
  const std::set<std::uint64_t> chosen(sequences.begin(), sequences.end());
  Positions positions;
  for (const TrajectoryPose& pose : session.trajectory) {
    if (chosen.contains(pose.sequence)) positions.emplace_back(pose.T_world_camera.translation());
  }
  return positions;
}

// Part of the path without a gap. Apart: nothing tells where it lies relative to the start.
struct Stretch {
  Positions positions;
  bool apart = false;
};

std::vector<Stretch> stretches_of(const Session& session) {
  std::vector<Stretch> stretches;
  auto next = session.submaps.begin();
  bool apart = false;
  bool in_gap = true;
  for (const TrajectoryPose& pose : session.trajectory) {
    bool begins = false;
    for (; next != session.submaps.end() && next->first_keyframe <= pose.sequence; ++next) {
      begins = true;
      apart = next->part != session.submaps.front().part;
    }
    if (pose.known && (in_gap || begins)) stretches.push_back({.apart = apart});
    if (pose.known) stretches.back().positions.emplace_back(pose.T_world_camera.translation());
    in_gap = !pose.known;
  }
  return stretches;
}

std::vector<std::uint64_t> predicted_frames(const Session& session) {
  std::vector<std::uint64_t> sequences;
  for (const FrameFigures& frame : session.frames) {
    if (frame.status == FrameOutcome::Status::kPredicted) sequences.push_back(frame.sequence);
  }
  return sequences;
}

// Where the camera was last known to be, and where it was known again.
Positions ends_of_gaps(const std::vector<TrajectoryPose>& trajectory) {
  Positions positions;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i - 1].known == trajectory[i].known) continue;
    const TrajectoryPose& end = trajectory[trajectory[i].known ? i : i - 1];
    positions.emplace_back(end.T_world_camera.translation());
  }
  return positions;
}

// Both ends of each.
Positions positions_of_loops(const Session& session) {
  std::vector<std::uint64_t> sequences;
  for (const LoopClosure& loop : session.loops) {
    sequences.push_back(loop.candidate);
    sequences.push_back(loop.current);
  }
  return positions_at(session, sequences);
}

// The camera looks along z when a session begins; on the chart, up.
Curve from_above(const Positions& positions) {
  Curve curve;
  for (const Eigen::Vector3d& p : positions) curve.emplace_back(p.x(), p.z());
  return curve;
}

Curve height_over_distance(const Positions& positions) {
  Curve curve;
  double distance = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (i > 0) distance += (positions[i] - positions[i - 1]).norm();
    curve.emplace_back(distance, -positions[i].y());
  }
  return curve;
}

// As high as the path asks for at full width, within what fits a screen.
double height_for(const std::vector<ChartSeries>& series, double width_px) {
  Interval x;
  Interval y;
  for (const ChartSeries& one : series) {
    for (const Eigen::Vector2d& point : one.points) {
      x.include(point.x());
      y.include(point.y());
    }
  }
  if (x.empty() || x.length() <= 0.0) return 480.0;
  return std::clamp(width_px * y.length() / x.length() + 60.0, 260.0, 640.0);
}

Chart segment_chart(const Evaluation& evaluation, const char* title, const char* y_label,
                    double SegmentMean::*error) {
  Chart chart{.title = title,
              .x_label = "segment length (m)",
              .y_label = y_label,
              .width_px = 460.0,
              .height_px = 250.0};
  ChartSeries bars{.kind = Kind::kBars, .ink = "estimate"};
  for (const SegmentMean& mean : evaluation.kitti.per_length) {
    bars.points.emplace_back(static_cast<double>(chart.x_names.size()), mean.*error);
    chart.x_names.push_back(fmt::format("{:g}", mean.key));
  }
  chart.series.push_back(std::move(bars));
  return chart;
}

}  // namespace

Chart path_chart(const Session& session) {
  Chart chart{.title = "Path from above",
              .x_label = "x, right (m)",
              .y_label = "z, forward (m)",
              .equal_axes = true};
  if (session.truth) {
    chart.series.push_back({.kind = Kind::kPath,
                            .name = "ground truth",
                            .ink = "truth",
                            .points = from_above(session.truth->positions)});
  }
  const auto add = [&](Kind kind, const char* name, const char* ink, const Positions& positions) {
    chart.series.push_back(
        {.kind = kind, .name = name, .ink = ink, .points = from_above(positions)});
  };
  const char* name = "Sparsight";
  const char* name_apart = "sub-map that nothing joins: where it lies is a guess";
  for (const Stretch& stretch : stretches_of(session)) {
    const char*& next_name = stretch.apart ? name_apart : name;
    add(Kind::kPath, next_name, stretch.apart ? "apart" : "estimate", stretch.positions);
    next_name = "";
  }
  if (!session.odometry.empty()) {
    add(Kind::kPath, "odometry, without loops", "dashed", positions_of(session.odometry));
  }
  add(Kind::kDots, "keyframes", "keyframe", positions_at(session, session.keyframes));
  add(Kind::kDots, "predicted, not measured", "fault",
      positions_at(session, predicted_frames(session)));
  add(Kind::kDots, "lost", "lost", ends_of_gaps(session.trajectory));
  if (!session.loops.empty()) add(Kind::kDots, "loops", "loop", positions_of_loops(session));
  if (!session.trajectory.empty()) {
    add(Kind::kDots, "start", "start", {session.trajectory.front().T_world_camera.translation()});
  }
  chart.height_px = height_for(chart.series, chart.width_px);
  return chart;
}

Chart height_chart(const Session& session) {
  Chart chart{.title = "Height along the path",
              .x_label = "distance travelled (m)",
              .y_label = "height, -y (m)"};
  if (session.truth) {
    chart.series.push_back({.kind = Kind::kCurve,
                            .name = "ground truth",
                            .ink = "truth",
                            .points = height_over_distance(session.truth->positions)});
  }
  chart.series.push_back({.kind = Kind::kCurve,
                          .name = "Sparsight",
                          .ink = "estimate",
                          .points = height_over_distance(positions_of(session.trajectory))});
  return chart;
}

std::vector<Chart> segment_charts(const Evaluation& evaluation) {
  return {segment_chart(evaluation, "Translation error by segment length", "t_rel (%)",
                        &SegmentMean::t_rel_percent),
          segment_chart(evaluation, "Rotation error by segment length", "r_rel (deg/m)",
                        &SegmentMean::r_rel_deg_per_m)};
}

Chart position_error_chart(const GroundTruth& truth) {
  Chart chart{.title = "Distance from the ground truth, best aligned",
              .x_label = "distance travelled (m)",
              .y_label = "error (m)",
              .y_includes = {0.0}};
  const Curve heights = height_over_distance(truth.positions);
  ChartSeries error{.kind = Kind::kCurve, .name = "each frame", .ink = "estimate"};
  const auto& errors_m = truth.evaluation.ate.errors_m;
  for (std::size_t i = 0; i < std::min(heights.size(), errors_m.size()); ++i) {
    error.points.emplace_back(heights[i].x(), errors_m[i]);
  }
  const double rmse_m = truth.evaluation.ate.rmse_m;
  chart.series.push_back(std::move(error));
  chart.series.push_back({.kind = Kind::kLevel,
                          .name = fmt::format("ATE (rmse) {:.3f} m", rmse_m),
                          .ink = "dashed",
                          .points = {{0.0, rmse_m}}});
  return chart;
}

}  // namespace sparsight
