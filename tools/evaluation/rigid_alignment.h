#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace sparsight {

// T_target_source that moves source points onto target points with the least sum of squares,
// without scale (Horn 1987; by SVD as in Umeyama, PAMI 1991). The two have the same, non-zero size.
// On a straight line the turn about the line is arbitrary, which changes no distance to the target;
// with all points in one place the rotation is.
Eigen::Isometry3d align_rigidly(const std::vector<Eigen::Vector3d>& target,
                                const std::vector<Eigen::Vector3d>& source);

}  // namespace sparsight
