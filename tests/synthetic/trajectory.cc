#include "tests/synthetic/trajectory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sparsight::synthetic {

CubicSpline::CubicSpline(std::vector<double> values, double start, double step)
    : values_(std::move(values)), curvatures_(values_.size(), 0.0), start_(start), step_(step) {
  // The tridiagonal system of the second derivatives, solved by elimination (Thomas).
  const std::size_t n = values_.size();
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double right =
        6.0 * (values_[i + 1] - 2.0 * values_[i] + values_[i - 1]) / (step_ * step_);
    const double pivot = 4.0 - upper[i - 1];
    upper[i] = 1.0 / pivot;
    curvatures_[i] = (right - curvatures_[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 1;) {
    if (i + 1 < n) curvatures_[i] -= upper[i] * curvatures_[i + 1];
  }
}

double CubicSpline::operator()(double x) const {
  const double last = static_cast<double>(values_.size() - 1);
  const double position = std::clamp((x - start_) / step_, 0.0, last);
  const auto i = static_cast<std::size_t>(std::min(position, last - 1.0));
  const double b = position - static_cast<double>(i);
  const double a = 1.0 - b;
  return a * values_[i] + b * values_[i + 1] +
         ((a * a * a - a) * curvatures_[i] + (b * b * b - b) * curvatures_[i + 1]) * step_ * step_ /
             6.0;
}

Eigen::Isometry3d Attitude::pose() const {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation() = position;
  result.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
  return result;
}

Trajectory::Trajectory(const std::vector<Attitude>& knots, double start, double step) {
  std::array<std::vector<double>, 6> values;
  for (const Attitude& knot : knots) {
    for (int i = 0; i < 3; ++i) values[static_cast<std::size_t>(i)].push_back(knot.position[i]);
    values[3].push_back(knot.yaw);
    values[4].push_back(knot.pitch);
    values[5].push_back(knot.roll);
  }
  for (std::size_t i = 0; i < 6; ++i) channels_[i] = CubicSpline(std::move(values[i]), start, step);
}

Eigen::Isometry3d Trajectory::operator()(double seconds) const {
  Attitude at{{channels_[0](seconds), channels_[1](seconds), channels_[2](seconds)},
              channels_[3](seconds),
              channels_[4](seconds),
              channels_[5](seconds)};
  if (shake) {
    const Attitude added = shake(seconds);
    at.position += Eigen::AngleAxisd(at.yaw, Eigen::Vector3d::UnitZ()) * added.position;
    at.yaw += added.yaw;
    at.pitch += added.pitch;
    at.roll += added.roll;
  }
  return at.pose();
}

}  // namespace sparsight::synthetic
