#include "slam/tracking/photometric_reference.h"

#include <cmath>
#include <limits>

#include "slam/geometry/se3.h"
#include "slam/image/interpolation.h"

namespace sparsight::reference {
namespace {

constexpr double kMinDepth = 1e-3;  // metres

void write(const Vector6d& J, double residual, double weight, std::size_t entry,
           Linearization& out) {
  out.residual[entry] = static_cast<float>(residual);
  out.weight[entry] = static_cast<float>(weight);
  for (int k = 0; k < 6; ++k) {
    out.J[static_cast<std::size_t>(k)][entry] = static_cast<float>(J(k));
  }
}

// d_r / d_xi by the chain rule: image gradient, projection, q = exp(xi) T p.
Vector6d d_residual_d_pose(const ImageSample& s, const CameraModel& camera,
                           const Eigen::Vector3d& q) {
  const Eigen::Vector2d normalized = q.head<2>() / q.z();
  Eigen::Matrix<double, 2, 3> d_normalized_d_q;
  d_normalized_d_q << 1.0, 0.0, -normalized.x(), 0.0, 1.0, -normalized.y();
  d_normalized_d_q /= q.z();
  Eigen::Matrix<double, 3, 6> d_q_d_xi;
  d_q_d_xi << -hat(q), Eigen::Matrix3d::Identity();
  const Eigen::RowVector2d gradient(s.du, s.dv);
  return (gradient * camera.d_pixel_d_normalized(normalized) * d_normalized_d_q * d_q_d_xi)
      .transpose();
}

}  // namespace

void linearize(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
               const Eigen::Isometry3d& T_camera_keyframe, const Brightness& brightness,
               Linearization& out) {
  out.resize(patches.entries());
  for (std::size_t i = 0; i < patches.entries(); ++i) {
    write(Vector6d::Zero(), 0.0, 0.0, i, out);
    const Eigen::Vector3d q =
        T_camera_keyframe * Eigen::Vector3d(patches.x[i], patches.y[i], patches.z[i]);
    Eigen::Vector2d pixel;
    if (!(q.z() > kMinDepth) || !camera.project(q, pixel)) continue;
    const auto u = static_cast<float>(pixel.x());
    const auto v = static_cast<float>(pixel.y());
    if (!can_sample(image.width, image.height, u, v)) continue;
    const ImageSample s = sample(image, u, v);
    const double expected = brightness.gain * patches.intensity[i] + brightness.offset;
    write(d_residual_d_pose(s, camera, q), s.value - expected, patches.weight[i], i, out);
  }
}

double student_t_weight(double residual, double student_t_dof, double sigma) {
  const double r = residual / sigma;
  return (student_t_dof + 1.0) / (student_t_dof + r * r);
}

double estimate_sigma(const Linearization& linearization, double student_t_dof,
                      double sigma_start) {
  double sigma = std::max(sigma_start, kMinSigma);
  for (int iteration = 0; iteration < 1000; ++iteration) {
    double squares = 0.0;
    double weights = 0.0;
    for (std::size_t i = 0; i < linearization.residual.size(); ++i) {
      const double r = linearization.residual[i];
      const double weight = linearization.weight[i];
      squares += weight * student_t_weight(r, student_t_dof, sigma) * r * r;
      weights += weight;
    }
    if (weights <= 0.0) return sigma;
    sigma = std::max(std::sqrt(squares / weights), kMinSigma);
  }
  return sigma;
}

double robust_cost(const Linearization& linearization, double student_t_dof, double sigma) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < linearization.residual.size(); ++i) {
    const double r = linearization.residual[i] / sigma;
    const double weight = linearization.weight[i];
    sum += 0.5 * weight * std::log1p(r * r / student_t_dof);
    weights += weight;
  }
  if (weights <= 0.0) return std::numeric_limits<double>::infinity();
  return (student_t_dof + 1.0) * sigma * sigma * sum / weights;
}

NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           double student_t_dof, double sigma) {
  NormalEquations result;
  for (std::size_t i = 0; i < linearization.residual.size(); ++i) {
    const double r = linearization.residual[i];
    const double weight = linearization.weight[i] * student_t_weight(r, student_t_dof, sigma);
    Eigen::Matrix<double, NormalEquations::kSize, 1> J;
    for (int k = 0; k < 6; ++k) J(k) = linearization.J[static_cast<std::size_t>(k)][i];
    J(6) = -patches.intensity[i];
    J(7) = -1.0;
    result.H += weight * J * J.transpose();
    result.b += weight * r * J;
  }
  return result;
}

}  // namespace sparsight::reference
