#include "tools/session/chart_marks.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/session/chart_thinning.h"

namespace sparsight {
namespace {

using Kind = ChartSeries::Kind;

constexpr double kRug_px = 9.0;

std::vector<Eigen::Vector2d> on_page(const ChartSeries& series, const ChartPlane& plane) {
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& point : series.points) {
    const Eigen::Vector2d p = plane.at(point);
    if (p.allFinite()) points.push_back(p);
  }
  return points;
}

std::string stroke(const ChartSeries& series, const std::vector<Eigen::Vector2d>& points) {
  std::string path;
  for (const Eigen::Vector2d& p : points) {
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.x(), p.y());
  }
  return fmt::format(R"(<path class="stroke {}" d="{}"/>)", series.ink, path);
}

// Each dot is a stroke without length and with a round end: one element for all.
std::string dots(const ChartSeries& series, const std::vector<Eigen::Vector2d>& points) {
  std::string path;
  for (const Eigen::Vector2d& p : points) path += fmt::format("M{:.1f} {:.1f}h0", p.x(), p.y());
  return fmt::format(R"(<path class="dots {}" d="{}"/>)", series.ink, path);
}

std::string rug(const ChartSeries& series, const ChartPlane& plane) {
  std::vector<Eigen::Vector2d> feet;
  for (const Eigen::Vector2d& point : series.points) {
    feet.emplace_back(plane.at(point).x(), plane.bottom());
  }
  std::string path;
  for (const Eigen::Vector2d& p : thin_path(feet, 1.0)) {
    path += fmt::format("M{:.1f} {:.1f}v-{}", p.x(), p.y(), kRug_px);
  }
  return fmt::format(R"(<path class="stroke {}" d="{}"/>)", series.ink, path);
}

std::string bars(const ChartSeries& series, const ChartPlane& plane) {
  std::string svg;
  const double half_width = 0.3 * (plane.at({1.0, 0.0}).x() - plane.at({0.0, 0.0}).x());
  for (const Eigen::Vector2d& point : series.points) {
    const Eigen::Vector2d top = plane.at(point);
    const double foot = plane.at({0.0, 0.0}).y();
    svg += fmt::format(
        R"(<rect class="bar {}" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)",
        series.ink, top.x() - half_width, top.y(), 2.0 * half_width, std::max(0.0, foot - top.y()));
  }
  return svg;
}

std::string level(const ChartSeries& series, const ChartPlane& plane) {
  const double y = plane.at(series.points.front()).y();
  return stroke(series, {{plane.left(), y}, {plane.right(), y}});
}

}  // namespace

std::string drawing_of(const ChartSeries& series, const ChartPlane& plane) {
  const auto columns = static_cast<std::size_t>(plane.right() - plane.left());
  if (series.points.empty()) return "";
  switch (series.kind) {
    case Kind::kCurve:
      return stroke(series, thin_curve(on_page(series, plane), columns / 2));
    case Kind::kPath:
      return stroke(series, thin_path(on_page(series, plane), 1.0));
    case Kind::kDots:
      return dots(series, thin_path(on_page(series, plane), 2.0));
    case Kind::kBars:
      return bars(series, plane);
    case Kind::kRug:
      return rug(series, plane);
    case Kind::kLevel:
      return level(series, plane);
  }
  return "";
}

}  // namespace sparsight
