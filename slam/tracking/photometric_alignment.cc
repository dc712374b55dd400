#include "slam/tracking/photometric_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/tracking/robust_model.h"

namespace sparsight {
namespace {

// What is believed of a frame's brightness before it is measured, weak beside thousands of pixels.
constexpr double kGainDeviation = 0.5;
constexpr double kOffsetDeviationGrey = 30.0;
constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e3;
constexpr double kLeastVisibleShare = 0.1;

using Vector8d = Eigen::Matrix<double, NormalEquations::kSize, 1>;

void add_brightness_prior(NormalEquations& n, const Alignment& at) {
  const double variance = at.sigma_grey * at.sigma_grey;
  const double gain_weight = variance / (kGainDeviation * kGainDeviation);
  const double offset_weight = variance / (kOffsetDeviationGrey * kOffsetDeviationGrey);
  n.H(6, 6) += gain_weight;
  n.H(7, 7) += offset_weight;
  n.b(6) += gain_weight * (at.brightness.gain - 1.0);
  n.b(7) += offset_weight * at.brightness.offset;
}

Vector8d solve(const NormalEquations& n, bool affine_brightness, double damping) {
  const int size = affine_brightness ? 8 : 6;
  // Of a size that varies within fixed bounds: nothing is allocated.
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                               NormalEquations::kSize, NormalEquations::kSize>;
  Square H = n.H.topLeftCorner(size, size);
  H.diagonal() *= 1.0 + damping;
  Vector8d step = Vector8d::Zero();
  step.head(size) = H.ldlt().solve(-n.b.head(size));
  return step;
}

Alignment stepped(const Alignment& from, const Vector8d& step) {
  Alignment to = from;
  to.T_camera_keyframe = exp_se3(step.head<6>()) * from.T_camera_keyframe;  // eq. (2)
  to.brightness.gain += step(6);
  to.brightness.offset += step(7);
  return to;
}

// Brightness is known only as well as this frame tells: its uncertainty goes into the pose's.
Matrix6d marginal_information(const NormalEquations& n, bool affine_brightness, double sigma) {
  Matrix6d H = n.H.topLeftCorner<6, 6>();
  if (affine_brightness) {
    const Eigen::Matrix<double, 6, 2> C = n.H.topRightCorner<6, 2>();
    const Eigen::Matrix2d B = n.H.bottomRightCorner<2, 2>();
    H -= C * B.ldlt().solve(C.transpose());
  }
  return H / (sigma * sigma);
}

class LevelAlignment {
 public:
  LevelAlignment(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
                 const PhotometryConfig& photometry, AlignmentWorkspace& workspace)
      : patches_(patches),
        image_(image),
        camera_(camera),
        photometry_(photometry),
        space_(workspace) {}

  // Linearises at the pose and estimates sigma there.
  Alignment assess(const Alignment& at) {
    evaluate(at, space_.current);
    return measured(at, visible_share(patches_, space_.current));
  }

  NormalEquations equations(const Alignment& at) const {
    return normal_equations(patches_, space_.current, at, photometry_);
  }

  // Takes the step if it lowers the cost for the sigma it was computed with.
  bool try_step(Alignment& at, const Vector8d& step) {
    const Alignment to = stepped(at, step);
    evaluate(to, space_.candidate);
    const double cost = robust_cost(space_.candidate, photometry_, at.sigma_grey);
    if (!(cost < at.cost)) return false;
    const double visible = visible_share(patches_, space_.candidate);
    if (visible < kLeastVisibleShare) return false;
    std::swap(space_.current, space_.candidate);
    at = measured(to, visible);
    return true;
  }

 private:
  void evaluate(const Alignment& at, Linearization& into) const {
    linearize(patches_, image_, camera_, at.T_camera_keyframe, at.brightness, into);
    if (photometry_.patch_weights) sum_patches(into);
  }

  // The scale is estimated in each iteration, after eq. (5).
  Alignment measured(Alignment at, double visible_share) const {
    at.sigma_grey = estimate_sigma(space_.current, photometry_, at.sigma_grey);
    at.cost = robust_cost(space_.current, photometry_, at.sigma_grey);
    at.visible_share = visible_share;
    return at;
  }

  const PatchSet& patches_;
  const GreyImage& image_;
  const CameraModel& camera_;
  const PhotometryConfig& photometry_;
  AlignmentWorkspace& space_;
};

// Upper bound of how far the step moves a point at mean depth in the image.
double step_px(const Vector8d& step, const CameraModel& camera, double mean_inverse_depth) {
  return camera.intrinsics().fx *
         (step.head<3>().norm() + step.segment<3>(3).norm() * mean_inverse_depth);
}

}  // namespace

Alignment align(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
                double mean_inverse_depth, const Alignment& start, const AlignmentConfig& config,
                const PhotometryConfig& photometry, AlignmentWorkspace& workspace,
                Information information) {
  LevelAlignment level(patches, image, camera, photometry, workspace);
  Alignment at = level.assess(start);
  at.converged = false;
  at.information.setZero();
  double damping = 0.0;
  NormalEquations n;
  bool moved = true;  // since n was computed
  for (int i = 0; i < config.max_iterations && !at.converged; ++i) {
    if (std::exchange(moved, false)) n = level.equations(at);
    const Vector8d step = solve(n, photometry.affine_brightness, damping);
    if (!step.allFinite()) break;
    const bool small = step_px(step, camera, mean_inverse_depth) < config.convergence_px;
    moved = level.try_step(at, step);
    if (moved) {
      damping = damping > kFirstDamping ? 0.1 * damping : 0.0;
    } else {
      damping = std::max(kFirstDamping, 10.0 * damping);
    }
    at.converged = small || damping > kMostDamping;  // no descent left at all: a minimum
  }
  if (information == Information::kLeftOut) return at;
  if (moved) n = level.equations(at);
  at.information = marginal_information(n, photometry.affine_brightness, at.sigma_grey);
  return at;
}

Alignment assess(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
                 const Alignment& at, const PhotometryConfig& photometry,
                 AlignmentWorkspace& workspace) {
  return LevelAlignment(patches, image, camera, photometry, workspace).assess(at);
}

NormalEquations normal_equations(const PatchSet& patches, const Linearization& linearization,
                                 const Alignment& at, const PhotometryConfig& photometry) {
  NormalEquations n = accumulate(patches, linearization, photometry, at.sigma_grey);
  if (photometry.affine_brightness) add_brightness_prior(n, at);
  return n;
}

}  // namespace sparsight
