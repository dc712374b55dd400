#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace sparsight {

// Leaves out what a chart cannot show, so that a report of many thousand frames stays light.

// Of a curve over x, increasing: the first, lowest, highest and last of each of `columns` equal
// stretches of x. No extreme is lost.
std::vector<Eigen::Vector2d> thin_curve(const std::vector<Eigen::Vector2d>& curve,
                                        std::size_t columns);

// Of a path in the plane: points at least `distance` from the one kept before, and the last.
std::vector<Eigen::Vector2d> thin_path(const std::vector<Eigen::Vector2d>& path, double distance);

}  // namespace sparsight
