#pragma once

#include "slam/tracking/photometric_kernel.h"

// The photometric kernel once more, entry by entry in double precision, as the equations are
// written. What the vector code must agree with; not for speed.
namespace sparsight::reference {

// As sparsight::linearize.
void linearize(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
               const Eigen::Isometry3d& T_camera_keyframe, const Brightness& brightness,
               Linearization& out);

// w(r) of eq. (5).
double student_t_weight(double residual, double student_t_dof, double sigma);

// As sparsight::estimate_sigma, run until it stands still.
double estimate_sigma(const Linearization& linearization, double student_t_dof, double sigma_start);

// As sparsight::robust_cost.
double robust_cost(const Linearization& linearization, double student_t_dof, double sigma);

// As sparsight::accumulate.
NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           double student_t_dof, double sigma);

}  // namespace sparsight::reference
