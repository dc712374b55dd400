#include "slam/calibration/self_calibration.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace sparsight {
namespace {

constexpr double kWorthwhilePx = 0.05;
constexpr double kMostSigmas = 3.0;
constexpr int kFinest = 0;
constexpr int kNuisance = NormalEquations::kSize;  // pose, gain, offset
using Row = Eigen::Matrix<double, 1, kNuisance>;

// What the parameters move: d_pixel / d_[log focal scale, k1].
Eigen::Matrix2d d_pixel_d_parameters(const CameraModel& camera, const Eigen::Vector2d& normalized,
                                     const Eigen::Vector2d& pixel) {
  const CameraIntrinsics& c = camera.intrinsics();
  Eigen::Matrix2d J;
  J.col(0) = pixel - Eigen::Vector2d(c.cx, c.cy);
  J.col(1) = normalized.cwiseProduct(Eigen::Vector2d(c.fx, c.fy)) * normalized.squaredNorm();
  return J;
}

struct Observation {
  Eigen::Vector3d p;  // in the host
  Eigen::Vector3d q;  // the same in the target
  Eigen::Vector2d p_pixel;
  Eigen::Vector2d q_pixel;
  Eigen::RowVector2d inverse_depth_slope;
};

// How the parameters move the pixel taken in the host and the pixel compared with it in the target
// apart. Both move by many pixels and nearly together; their difference is geometry, free of the
// images' noise, which would otherwise pass for information. The host's pixel slides over the
// surface as it moves.
Eigen::Matrix2d d_apart_d_parameters(const CameraModel& camera, const Eigen::Matrix3d& R,
                                     const Observation& o) {
  const Eigen::Vector2d n_host = o.p.head<2>() / o.p.z();
  const Eigen::Vector2d n_target = o.q.head<2>() / o.q.z();
  const Eigen::Matrix2d host = d_pixel_d_parameters(camera, n_host, o.p_pixel);
  Eigen::Matrix<double, 3, 2> d_p = -o.p.z() * o.p * (o.inverse_depth_slope * host);
  d_p.topRows<2>() += o.p.z() * camera.d_pixel_d_normalized(n_host).inverse() * host;
  Eigen::Matrix<double, 2, 3> d_normalized_d_q;
  d_normalized_d_q << 1.0, 0.0, -n_target.x(), 0.0, 1.0, -n_target.y();
  d_normalized_d_q /= o.q.z();
  return d_pixel_d_parameters(camera, n_target, o.q_pixel) -
         camera.d_pixel_d_normalized(n_target) * d_normalized_d_q * R * d_p;
}

// The image's gradient at the target's pixel, out of d_residual / d_translation.
Eigen::RowVector2d gradient(const Linearization& l, std::size_t i, const CameraModel& camera,
                            const Eigen::Vector3d& q) {
  const Eigen::RowVector2d d_normalized(q.z() * l.J[3][i], q.z() * l.J[4][i]);
  return d_normalized * camera.d_pixel_d_normalized(q.head<2>() / q.z()).inverse();
}

}  // namespace

SelfCalibration::SelfCalibration(const CameraIntrinsics& given, const SelfCalibrationConfig& config)
    : given_(given),
      sigma_(config.focal_sigma, config.k1_sigma),
      believed_share_(config.believed_share),
      camera_(given),
      H_(sigma_.array().square().inverse().matrix().asDiagonal()) {}

CameraModel SelfCalibration::with(const Parameters& parameters) const {
  CameraIntrinsics c = given_;
  c.fx *= std::exp(parameters(0));
  c.fy *= std::exp(parameters(0));
  c.k1 += parameters(1);
  return CameraModel(c);
}

void SelfCalibration::observe(const Keyframe& host, const Alignment& at,
                              const Linearization& linearization,
                              const PhotometryConfig& photometry) {
  const PatchSet& patches = host.patches[kFinest];
  const double variance = at.sigma_grey * at.sigma_grey;
  const double dof = photometry.student_t_dof;
  NormalEquations n = accumulate(patches, linearization, dof, at.sigma_grey);
  Eigen::Matrix<double, kNuisance, 2> C = Eigen::Matrix<double, kNuisance, 2>::Zero();
  Eigen::Matrix2d own = Eigen::Matrix2d::Zero();
  Parameters slope = Parameters::Zero();
  for (std::size_t i = 0; i < patches.entries(); ++i) {
    if (linearization.weight[i] <= 0.0F) continue;
    Observation o;
    o.p = {patches.x[i], patches.y[i], patches.z[i]};
    o.q = at.T_camera_keyframe * o.p;
    if (!camera_.project(o.p, o.p_pixel) || !camera_.project(o.q, o.q_pixel)) continue;
    o.inverse_depth_slope = host.points[i / kPatternSize].inverse_depth_slope.cast<double>();
    Row J;
    for (std::size_t k = 0; k < 6; ++k) J(static_cast<int>(k)) = linearization.J[k][i];
    J(6) = -patches.intensity[i];
    J(7) = -1.0;
    const Eigen::RowVector2d J_own =
        gradient(linearization, i, camera_, o.q) *
        d_apart_d_parameters(camera_, at.T_camera_keyframe.linear(), o);
    const double r = linearization.residual[i];
    const double weight = linearization.weight[i] * (dof + 1.0) / (dof + r * r / variance);
    C.noalias() += weight * J.transpose() * J_own;
    own.noalias() += weight * J_own.transpose() * J_own;
    slope += weight * r * J_own.transpose();
  }
  // The nuisances' damping is far below anything that pixels tell.
  n.H.diagonal().array() += 1e-6;
  const auto nuisance = n.H.ldlt();
  const Eigen::Matrix2d information = own - C.transpose() * nuisance.solve(C);
  const Parameters gradient = slope - C.transpose() * nuisance.solve(n.b);
  const double share = believed_share_ / variance;
  H_ += share * information;
  b_ += share * (information * in_force_ - gradient);
}

bool SelfCalibration::update() {
  const Parameters most = kMostSigmas * sigma_;
  const Parameters best = H_.ldlt().solve(b_).cwiseMax(-most).cwiseMin(most);
  const CameraModel candidate = with(best);
  Eigen::Vector2d moved;
  if (!candidate.project(camera_.unproject(Eigen::Vector2d::Zero()), moved)) return false;
  if (!(moved.norm() >= kWorthwhilePx)) return false;  // NaN as well
  in_force_ = best;
  camera_ = candidate;
  return true;
}

}  // namespace sparsight
