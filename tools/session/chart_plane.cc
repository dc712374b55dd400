#include "tools/session/chart_plane.h"

#include <algorithm>

namespace sparsight {
namespace {

using Kind = ChartSeries::Kind;

constexpr double kLeft_px = 70.0;  // room for the labels of the y axis
constexpr double kRight_px = 14.0;
constexpr double kTop_px = 8.0;
constexpr double kBottom_px = 44.0;
constexpr double kTickDistanceX_px = 80.0;  // no closer, or labels touch
constexpr double kTickDistanceY_px = 30.0;

// Bars stand at 0, 1, 2 ...; half a bar's distance is free on both sides.
Interval x_range(const Chart& chart, const Interval& values) {
  if (!chart.x_names.empty()) return {-0.6, static_cast<double>(chart.x_names.size()) - 0.4};
  if (values.empty()) return {0.0, 1.0};
  if (values.length() <= 0.0) return {values.min - 0.5, values.max + 0.5};
  return values;
}

}  // namespace

ChartPlane::ChartPlane(const Chart& chart)
    : width_(chart.width_px - kLeft_px - kRight_px),
      height_(chart.height_px - kTop_px - kBottom_px),
      whole_x_(chart.whole_x) {
  for (const ChartSeries& series : chart.series) include(series);
  for (const double x : chart.x_includes) x_.include(x);
  for (const double y : chart.y_includes) y_.include(y);
  x_ = x_range(chart, x_);
  if (chart.equal_axes) {
    equalize();
  } else {
    y_ = widened_to_ticks(y_, most_y());
  }
}

Eigen::Vector2d ChartPlane::at(const Eigen::Vector2d& values) const {
  return {kLeft_px + (values.x() - x_.min) / x_.length() * width_,
          kTop_px + (y_.max - values.y()) / y_.length() * height_};
}

double ChartPlane::left() const { return kLeft_px; }
double ChartPlane::right() const { return kLeft_px + width_; }
double ChartPlane::top() const { return kTop_px; }
double ChartPlane::bottom() const { return kTop_px + height_; }

Ticks ChartPlane::x_ticks() const { return nice_ticks(x_, most_x(), whole_x_); }
Ticks ChartPlane::y_ticks() const { return nice_ticks(y_, most_y()); }

void ChartPlane::include(const ChartSeries& series) {
  for (const Eigen::Vector2d& point : series.points) {
    if (series.kind != Kind::kLevel) x_.include(point.x());
    if (series.kind != Kind::kRug) y_.include(point.y());
  }
  if (series.kind == Kind::kBars) y_.include(0.0);
}

// The larger of the two scales (metres per pixel) holds for both axes, with a margin around.
void ChartPlane::equalize() {
  if (y_.empty()) y_ = {0.0, 1.0};
  const double scale = 1.06 * std::max({x_.length() / width_, y_.length() / height_, 1e-3});
  x_ = {x_.middle() - 0.5 * scale * width_, x_.middle() + 0.5 * scale * width_};
  y_ = {y_.middle() - 0.5 * scale * height_, y_.middle() + 0.5 * scale * height_};
}

int ChartPlane::most_x() const { return std::max(2, static_cast<int>(width_ / kTickDistanceX_px)); }
int ChartPlane::most_y() const {
  return std::max(2, static_cast<int>(height_ / kTickDistanceY_px));
}

}  // namespace sparsight
