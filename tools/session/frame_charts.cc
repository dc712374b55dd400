#include <fmt/format.h>

#include <functional>

#include "tools/session/report_charts.h"

namespace sparsight {
namespace {

using Kind = ChartSeries::Kind;
using Figure = std::function<double(const FrameFigures&)>;

ChartSeries over_frames(const Session& session, Kind kind, std::string name, std::string ink,
                        const std::function<bool(const FrameFigures&)>& chosen,
                        const Figure& figure) {
  ChartSeries series{.kind = kind, .name = std::move(name), .ink = std::move(ink)};
  for (const FrameFigures& frame : session.frames) {
    if (chosen(frame)) {
      series.points.emplace_back(static_cast<double>(frame.sequence), figure(frame));
    }
  }
  return series;
}

bool any(const FrameFigures&) { return true; }
bool keyframe(const FrameFigures& frame) { return frame.keyframe; }
bool predicted(const FrameFigures& frame) {
  return frame.status == FrameOutcome::Status::kPredicted ||
         frame.status == FrameOutcome::Status::kLost;
}
bool measured(const FrameFigures& frame) { return frame.status == FrameOutcome::Status::kTracked; }

ChartSeries level(const char* name, const char* ink, double value_ms) {
  return {.kind = Kind::kLevel,
          .name = fmt::format("{} {:.2f} ms", name, value_ms),
          .ink = ink,
          .points = {{0.0, value_ms}}};
}

Chart frame_chart(const Session& session, const char* title, const char* y_label) {
  Chart chart{.title = title,
              .x_label = "frame",
              .y_label = y_label,
              .height_px = 210.0,
              .whole_x = true,
              .y_includes = {0.0}};
  if (!session.frames.empty()) {  // the same frames, so that charts line up
    chart.x_includes = {static_cast<double>(session.frames.front().sequence),
                        static_cast<double>(session.frames.back().sequence)};
  }
  chart.series.push_back(over_frames(session, Kind::kRug, "predicted or lost", "fault", predicted,
                                     [](const auto&) { return 0.0; }));
  return chart;
}

}  // namespace

Chart tracking_time_chart(const Session& session, const SessionSummary& summary) {
  Chart chart = frame_chart(session, "Tracking time", "time (ms)");
  chart.series.push_back(
      over_frames(session, Kind::kCurve, "each frame", "estimate", any,
                  [](const auto& f) { return to_milliseconds(f.tracking_time); }));
  chart.series.push_back(level("median", "dashed", summary.tracking.median_ms));
  chart.series.push_back(level("p99", "dotted", summary.tracking.p99_ms));
  return chart;
}

Chart window_time_chart(const Session& session, const SessionSummary& summary) {
  Chart chart = frame_chart(session, "Window optimisation time", "time (ms)");
  chart.series.push_back(over_frames(session, Kind::kDots, "each keyframe", "keyframe", keyframe,
                                     [](const auto& f) { return to_milliseconds(f.window_time); }));
  chart.series.push_back(level("median", "dashed", summary.window.median_ms));
  chart.series.push_back(level("p99", "dotted", summary.window.p99_ms));
  return chart;
}

Chart points_chart(const Session& session) {
  Chart chart = frame_chart(session, "Points used", "points");
  chart.series.push_back(
      over_frames(session, Kind::kCurve, "", "estimate", measured,
                  [](const auto& f) { return static_cast<double>(f.points_used); }));
  return chart;
}

Chart sigma_chart(const Session& session) {
  Chart chart = frame_chart(session, "Scale of the photometric residual", "sigma (grey levels)");
  chart.series.push_back(over_frames(session, Kind::kCurve, "", "estimate", measured,
                                     [](const auto& f) { return f.sigma_grey; }));
  return chart;
}

Chart visibility_chart(const Session& session) {
  Chart chart = frame_chart(session, "Keyframe points still in view", "share");
  const double threshold = session.description.config.keyframes.min_visible_ratio;
  const auto ratio = [](const FrameFigures& f) { return f.visible_ratio; };
  chart.series.push_back(
      over_frames(session, Kind::kCurve, "each frame", "estimate", measured, ratio));
  chart.series.push_back(over_frames(
      session, Kind::kDots, "becomes a keyframe", "keyframe",
      [](const auto& f) { return f.keyframe && measured(f); }, ratio));
  chart.series.push_back({.kind = Kind::kLevel,
                          .name = fmt::format("keyframe below {:g}", threshold),
                          .ink = "dashed",
                          .points = {{0.0, threshold}}});
  chart.y_includes = {1.0};
  return chart;
}

Chart attempts_chart(const Session& session) {
  Chart chart = frame_chart(session, "Starting motions tried", "attempts");
  chart.series.push_back(over_frames(session, Kind::kCurve, "", "estimate", any, [](const auto& f) {
    return static_cast<double>(f.attempts);
  }));
  return chart;
}

}  // namespace sparsight
