#pragma once

#include <string>

#include "tools/session/chart.h"

namespace sparsight {

// An HTML figure: title and legend above an SVG, which scales with the page.
std::string figure_of(const Chart& chart);

// Text as HTML shows it.
std::string escaped(const std::string& text);

}  // namespace sparsight
