#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sparsight {

// A chart as what it shows. Colours and strokes are the style sheet's, by the ink's name.
struct ChartSeries {
  enum class Kind {
    kCurve,  // a line over increasing x
    kPath,   // a line in the plane
    kDots,
    kBars,   // from 0 to y
    kRug,    // short strokes on the x axis; y is not used
    kLevel,  // a line across the chart at the y of its one point
  };
  Kind kind = Kind::kCurve;
  std::string name;  // in the legend; none if empty
  std::string ink;   // a class of report_style.h: estimate, truth, keyframe, fault ...
  std::vector<Eigen::Vector2d> points;
};

struct Chart {
  std::string title;
  std::string x_label;  // with its unit
  std::string y_label;
  double width_px = 920.0;
  double height_px = 240.0;
  bool equal_axes = false;         // a metre is as long upwards as sideways
  bool whole_x = false;            // x counts something
  std::vector<double> x_includes;  // values the axes show in any case
  std::vector<double> y_includes;
  std::vector<std::string> x_names;  // for bars: the names of x = 0, 1, 2 ...
  std::vector<ChartSeries> series;
};

}  // namespace sparsight
