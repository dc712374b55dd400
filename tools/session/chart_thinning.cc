#include "tools/session/chart_thinning.h"

#include <algorithm>

namespace sparsight {
namespace {

using Curve = std::vector<Eigen::Vector2d>;

void keep_extremes(Curve::const_iterator begin, Curve::const_iterator end, Curve& kept) {
  if (begin == end) return;
  const auto lower = [](const auto& a, const auto& b) { return a.y() < b.y(); };
  const auto [lowest, highest] = std::minmax_element(begin, end, lower);
  std::vector<Curve::const_iterator> chosen = {begin, lowest, highest, end - 1};
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  for (const auto point : chosen) kept.push_back(*point);
}

// The ends of level stretches say it all.
Curve without_level_middles(const Curve& curve) {
  Curve kept;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const bool level = i > 0 && i + 1 < curve.size() && curve[i - 1].y() == curve[i].y() &&
                       curve[i].y() == curve[i + 1].y();
    if (!level) kept.push_back(curve[i]);
  }
  return kept;
}

}  // namespace

Curve thin_curve(const Curve& all, std::size_t columns) {
  Curve curve = without_level_middles(all);
  if (curve.size() <= 4 * columns) return curve;
  const double left = curve.front().x();
  const double width = (curve.back().x() - left) / static_cast<double>(columns);
  Curve kept;
  auto begin = curve.begin();
  for (std::size_t column = 1; column < columns; ++column) {
    const double right = left + width * static_cast<double>(column);
    const auto end =
        std::find_if(begin, curve.end(), [&](const auto& p) { return p.x() >= right; });
    keep_extremes(begin, end, kept);
    begin = end;
  }
  keep_extremes(begin, curve.end(), kept);
  return kept;
}

Curve thin_path(const Curve& path, double distance) {
  Curve kept;
  for (const Eigen::Vector2d& point : path) {
    if (kept.empty() || (point - kept.back()).norm() >= distance) kept.push_back(point);
  }
  if (!path.empty() && kept.back() != path.back()) kept.push_back(path.back());
  return kept;
}

}  // namespace sparsight
