#include "tools/session/chart_thinning.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

using Curve = std::vector<Eigen::Vector2d>;

TEST(ChartThinning, LevelStretchesKeepTheirEnds) {
  const Curve curve = {{0, 1}, {1, 1}, {2, 1}, {3, 5}, {4, 1}, {5, 1}, {6, 1}};
  EXPECT_EQ(thin_curve(curve, 100), (Curve{{0, 1}, {2, 1}, {3, 5}, {4, 1}, {6, 1}}));
}

RC_GTEST_PROP(ChartThinning, CurveKeepsItsExtremesItsEndsAndItsOrder, ()) {
  const auto heights = *rc::gen::container<std::vector<int>>(
      static_cast<std::size_t>(*rc::gen::inRange(1, 2000)), rc::gen::inRange(-1000, 1000));
  Curve curve;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    curve.emplace_back(static_cast<double>(i), heights[i]);
  }
  const Curve thin = thin_curve(curve, 50);
  const auto lower = [](const auto& a, const auto& b) { return a.y() < b.y(); };
  RC_ASSERT(thin.size() <= 200U);
  RC_ASSERT(thin.front() == curve.front() && thin.back() == curve.back());
  RC_ASSERT(std::is_sorted(thin.begin(), thin.end(),
                           [](const auto& a, const auto& b) { return a.x() < b.x(); }));
  RC_ASSERT(std::max_element(thin.begin(), thin.end(), lower)->y() ==
            std::max_element(curve.begin(), curve.end(), lower)->y());
  RC_ASSERT(std::min_element(thin.begin(), thin.end(), lower)->y() ==
            std::min_element(curve.begin(), curve.end(), lower)->y());
}

RC_GTEST_PROP(ChartThinning, PathStaysWithinTheDistanceOfWhatIsKept, ()) {
  Curve path = {{0, 0}};
  const auto turns = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 628));
  for (const int turn : turns) {
    const double angle = 0.01 * turn;
    path.push_back(path.back() + 0.3 * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const Curve thin = thin_path(path, 1.0);
  RC_ASSERT(thin.back() == path.back());
  for (const Eigen::Vector2d& point : path) {
    RC_ASSERT(std::any_of(thin.begin(), thin.end(),
                          [&](const auto& kept) { return (kept - point).norm() <= 1.0 + 1e-9; }));
  }
}

TEST(ChartThinning, NothingStaysNothing) {
  EXPECT_TRUE(thin_curve({}, 10).empty());
  EXPECT_TRUE(thin_path({}, 1.0).empty());
}

}  // namespace
}  // namespace sparsight
