#include "slam/window/pair_term.h"

#include <Eigen/LU>

#include "slam/tracking/robust_model.h"

namespace sparsight {
namespace {

constexpr int kFinest = 0;

void eliminate_brightness(const NormalEquations& n, double information_scale, PairTerm& term) {
  const Eigen::Matrix<double, 6, 2> C = n.H.topRightCorner<6, 2>();
  const Eigen::Matrix2d B_inverse = n.H.bottomRightCorner<2, 2>().inverse();
  term.brightness_step = -B_inverse * n.b.tail<2>();
  term.d_brightness_d_pose = -B_inverse * C.transpose();
  term.H += information_scale * C * term.d_brightness_d_pose;
  term.b += information_scale * C * term.brightness_step;
}

}  // namespace

Alignment PairTerm::moved(const Vector6d& xi) const {
  const Eigen::Vector2d brightness = brightness_step + d_brightness_d_pose * xi;
  Alignment to = at;
  to.T_camera_keyframe = exp_se3(xi) * at.T_camera_keyframe;
  to.brightness.gain += brightness.x();
  to.brightness.offset += brightness.y();
  return to;
}

PairTerm pair_term(const Keyframe& host, const Keyframe& target, const CameraModel& camera,
                   const Alignment& start, const PhotometryConfig& photometry,
                   AlignmentWorkspace& workspace) {
  const PatchSet& patches = host.patches[kFinest];
  PairTerm term;
  term.at = assess(patches, target.pyramid.level(kFinest), camera, start, photometry, workspace);
  const NormalEquations n = normal_equations(patches, workspace.current, term.at, photometry);
  const double information_scale = 1.0 / (term.at.sigma_grey * term.at.sigma_grey);
  term.H = information_scale * n.H.topLeftCorner<6, 6>();
  term.b = information_scale * n.b.head<6>();
  if (photometry.affine_brightness) eliminate_brightness(n, information_scale, term);

  term.pixels = weight_sum(workspace.current.weight);
  term.energy = term.pixels * term.at.cost * information_scale;
  return term;
}

double energy_at(const PairTerm& term, const Linearization& linearization,
                 const PhotometryConfig& photometry) {
  const double sigma = term.at.sigma_grey;
  return term.pixels * robust_cost(linearization, photometry, sigma) / (sigma * sigma);
}

}  // namespace sparsight
