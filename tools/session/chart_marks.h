#pragma once

#include <string>

#include "tools/session/chart_plane.h"

namespace sparsight {

// The SVG elements of one series. At most a few thousand points are drawn, extremes among them.
std::string drawing_of(const ChartSeries& series, const ChartPlane& plane);

}  // namespace sparsight
