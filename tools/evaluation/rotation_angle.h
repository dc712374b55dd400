#pragma once

#include <Eigen/Core>

namespace sparsight {

// Angle of a rotation, in [0, pi]. Exact for small angles, where the arc cosine of the trace (as in
// the KITTI development kit) turns a rounding error of 1e-7 into 3e-4 rad.
double rotation_angle_rad(const Eigen::Matrix3d& R);

}  // namespace sparsight
