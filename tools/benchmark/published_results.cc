#include "tools/benchmark/published_results.h"

#include <algorithm>
#include <array>

namespace sparsight {
namespace {

constexpr std::array<PublishedErrors, 11> kTable2 = {{
    {"00", 1.05, 0.93, 0.93, 0.95},
    {"01", 1.87, 1.47, 1.09, 7.25},
    {"02", 0.93, 1.11, 1.26, 0.95},
    {"03", 0.99, 0.92, 0.98, 0.94},
    {"04", 1.23, 0.67, 1.08, 1.08},
    {"05", 1.04, 0.82, 0.77, 0.77},
    {"06", 0.96, 0.92, 0.75, 0.75},
    {"07", 1.16, 1.26, 1.30, 1.42},
    {"08", 1.24, 1.32, 1.30, 1.30},
    {"09", 1.17, 0.66, 0.72, 0.72},
    {"10", 1.14, 0.70, 0.57, 0.57},
}};

}  // namespace

std::optional<PublishedErrors> published_errors(std::string_view sequence) {
  const auto row = std::ranges::find(kTable2, sequence, &PublishedErrors::sequence);
  return row == kTable2.end() ? std::nullopt : std::optional(*row);
}

}  // namespace sparsight
