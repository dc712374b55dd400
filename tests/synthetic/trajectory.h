#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <vector>

namespace sparsight::synthetic {

// Natural cubic spline through values at equal steps: smooth up to the second derivative.
class CubicSpline {
 public:
  CubicSpline() = default;
  CubicSpline(std::vector<double> values, double start, double step);

  double operator()(double x) const;  // the end values continue beyond the ends

 private:
  std::vector<double> values_;
  std::vector<double> curvatures_;
  double start_ = 0.0;
  double step_ = 1.0;
};

// Position in the world, and the heading as a driver would name it: yaw to the left, pitch with the
// nose down, roll to the right. Radians, unwrapped.
struct Attitude {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0;
  double pitch = 0.0;
  double roll = 0.0;

  Eigen::Isometry3d pose() const;
};

// Exact pose of the body (x forward, y left, z up) at any time.
class Trajectory {
 public:
  Trajectory() = default;
  // Through the attitudes at start, start + step, ... seconds.
  Trajectory(const std::vector<Attitude>& knots, double start, double step);

  Eigen::Isometry3d operator()(double seconds) const;

  // Adds what a step or a rough road adds; for motions faster than the knots.
  std::function<Attitude(double seconds)> shake;

 private:
  std::array<CubicSpline, 6> channels_;
};

}  // namespace sparsight::synthetic
