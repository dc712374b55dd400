#include "slam/lidar/sweep_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace sparsight {
namespace {

constexpr int kIterations = 10;
constexpr double kStudentDof = 5.0;
constexpr double kRangeNoise = 0.02;  // metres
// Of a return's distance to its plane, in units of what both scatter: the first guess, and the
// least.
constexpr double kFirstScale = 5.0;
constexpr double kLeastScale = 0.5;
// Farther from its plane a return says nothing: a metre at first, then less as the fit gets tight.
constexpr double kGateM = 0.2;  // per unit of scale
constexpr double kLeastGateM = 0.3;
constexpr double kOnSurface = 3.0;  // sigma of range and plane
constexpr std::size_t kFewest = 50;
constexpr double kRotationEnds = 1e-5;     // radians
constexpr double kTranslationEnds = 1e-4;  // metres

// Of the squared distance up to which a return's area counts.
float largest_square(std::span<const Eigen::Vector3f> returns) {
  // Every return is as good as any other: the median of the first is that of all.
  std::array<float, 255> squares{};
  const std::size_t n = std::min(squares.size(), returns.size());
  for (std::size_t i = 0; i < n; ++i) squares[i] = returns[i].squaredNorm();
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(squares.begin(), middle, squares.begin() + static_cast<std::ptrdiff_t>(n));
  return 4.0F * *middle;
}

struct Equations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  double area = 0.0;
  double on_surface = 0.0;
  double squares = 0.0;
  Eigen::Matrix3d facing = Eigen::Matrix3d::Zero();
  std::size_t returns = 0;
};

Equations linearize(const SweepSurface& surface, std::span<const Eigen::Vector3f> returns,
                    const Eigen::Isometry3d& T_keyframe_lidar, float largest, double scale) {
  const Eigen::Matrix3f R = T_keyframe_lidar.linear().cast<float>();
  const Eigen::Vector3f t = T_keyframe_lidar.translation().cast<float>();
  const double gate = std::clamp(kGateM * scale, kLeastGateM, kGateM * kFirstScale);
  Equations sum;
  for (const Eigen::Vector3f& p : returns) {
    const Eigen::Vector3f q = R * p + t;
    const SweepSurface::Plane* plane = surface.at(q);
    if (plane == nullptr) continue;
    const Eigen::Vector3f from_centre = q - plane->centre;
    const float distance = plane->normal.dot(from_centre);
    const float along2 = from_centre.squaredNorm() - distance * distance;
    const float reach = 1.5F * plane->reach_m + 0.1F;
    if (along2 > reach * reach) continue;
    const double noise2 = kRangeNoise * kRangeNoise + plane->thickness_m * plane->thickness_m;
    const double square = distance * distance / noise2;
    const double area = std::min(p.squaredNorm(), largest) / largest;
    sum.area += area;
    ++sum.returns;
    const bool on_surface = square < kOnSurface * kOnSurface;
    if (on_surface) sum.on_surface += area;
    if (std::abs(distance) > gate) continue;
    const double weight = area * (kStudentDof + 1.0) / (kStudentDof + square / (scale * scale));
    Vector6d J;
    J << q.cross(plane->normal).cast<double>(), plane->normal.cast<double>();
    sum.H.noalias() += weight / noise2 * J * J.transpose();
    sum.b += weight / noise2 * distance * J;
    sum.squares += weight * square;
    if (on_surface) {
      const Eigen::Vector3d n = plane->normal.cast<double>();
      sum.facing.noalias() += n * n.transpose();
    }
  }
  return sum;
}

SweepFit fit(const Equations& at, const Eigen::Isometry3d& T_keyframe_lidar, double scale) {
  SweepFit result{.T_keyframe_lidar = T_keyframe_lidar, .returns = at.returns};
  if (at.returns < kFewest || !(at.area > 0.0)) return result;
  result.share = at.on_surface / at.area;
  result.facing = at.facing;
  result.information = at.H * (static_cast<double>(at.returns) / (at.area * scale * scale));
  return result;
}

}  // namespace

SweepFit fit_of_sweep(const SweepSurface& surface, std::span<const Eigen::Vector3f> returns,
                      const Eigen::Isometry3d& T_keyframe_lidar) {
  if (!T_keyframe_lidar.matrix().allFinite()) return {};
  const Equations at = linearize(surface, returns, T_keyframe_lidar, largest_square(returns), 1.0);
  return fit(at, T_keyframe_lidar, 1.0);
}

SweepFit align_sweep(const SweepSurface& surface, std::span<const Eigen::Vector3f> returns,
                     const Eigen::Isometry3d& start) {
  if (!start.matrix().allFinite()) return {};
  const float largest = largest_square(returns);
  Eigen::Isometry3d T = start;
  double scale = kFirstScale;
  for (int i = 0;; ++i) {
    const Equations at = linearize(surface, returns, T, largest, scale);
    if (at.returns < kFewest || !(at.area > 0.0)) return fit(at, T, scale);
    scale = std::max(kLeastScale, std::sqrt(at.squares / at.area));
    if (i == kIterations) return fit(at, T, scale);
    const Matrix6d damping = 1e-6 * at.H.trace() * Matrix6d::Identity();
    const Vector6d step = (at.H + damping).ldlt().solve(-at.b);
    T = renormalized(exp_se3(step) * T);
    if (step.head<3>().norm() < kRotationEnds && step.tail<3>().norm() < kTranslationEnds) {
      return fit(at, T, scale);
    }
  }
}

}  // namespace sparsight
