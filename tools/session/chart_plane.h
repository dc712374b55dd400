#pragma once

#include <Eigen/Core>

#include "tools/session/chart.h"
#include "tools/session/chart_axis.h"

namespace sparsight {

// A chart's rectangle on the page and the values it spans, chosen to hold all series.
class ChartPlane {
 public:
  explicit ChartPlane(const Chart& chart);

  // Pixels of the page, y down.
  Eigen::Vector2d at(const Eigen::Vector2d& values) const;
  double left() const;
  double right() const;
  double top() const;
  double bottom() const;

  Ticks x_ticks() const;
  Ticks y_ticks() const;

 private:
  void include(const ChartSeries& series);
  void equalize();
  int most_x() const;
  int most_y() const;

  double width_;
  double height_;
  bool whole_x_;
  Interval x_;
  Interval y_;
};

}  // namespace sparsight
