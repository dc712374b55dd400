#include "tests/synthetic/scenes/motions.h"

#include <algorithm>
#include <cmath>

namespace sparsight::synthetic {
namespace {

constexpr double kKnotStep = 0.25;

Attitude springs(double t) {
  const auto wave = [t](double hz, double phase) { return std::sin(2.0 * M_PI * hz * t + phase); };
  Attitude a;
  a.position = {0.0, 0.006 * wave(0.7, 1.0), 0.010 * wave(1.3, 0.2) + 0.004 * wave(4.1, 2.0)};
  a.yaw = 0.0010 * wave(0.9, 0.5);
  a.pitch = 0.0035 * wave(1.2, 1.7) + 0.0012 * wave(3.7, 0.1);
  a.roll = 0.0030 * wave(0.8, 2.9) + 0.0010 * wave(5.3, 0.7);
  return a;
}

Attitude steps(double t) {
  const auto wave = [t](double hz, double phase) { return std::sin(2.0 * M_PI * hz * t + phase); };
  Attitude a;
  a.position = {0.008 * wave(2.0, 1.1), 0.022 * wave(1.0, 0.3),
                0.020 * wave(2.0, 0.0) + 0.004 * wave(4.0, 1.9)};
  a.yaw = 0.030 * wave(1.0, 1.2) + 0.015 * wave(0.37, 0.4);
  a.pitch = 0.020 * wave(2.0, 2.2) + 0.030 * wave(0.23, 1.0);
  a.roll = 0.025 * wave(1.0, 2.6) + 0.010 * wave(0.31, 0.0);
  return a;
}

// Points of the path at even distances, each corner replaced by a quadratic arc.
std::vector<Eigen::Vector2d> rounded(const Walk& walk, double spacing) {
  std::vector<Eigen::Vector2d> dense;
  const auto line_to = [&](const Eigen::Vector2d& end) {
    const Eigen::Vector2d begin = dense.back();
    const int n = std::max(1, static_cast<int>((end - begin).norm() / 0.01));
    for (int i = 1; i <= n; ++i) dense.push_back(begin + (end - begin) * i / n);
  };
  dense.push_back(walk.corners.front());
  for (std::size_t i = 1; i + 1 < walk.corners.size(); ++i) {
    const Eigen::Vector2d& corner = walk.corners[i];
    const Eigen::Vector2d in = corner + walk.corner_m * (walk.corners[i - 1] - corner).normalized();
    const Eigen::Vector2d out =
        corner + walk.corner_m * (walk.corners[i + 1] - corner).normalized();
    line_to(in);
    for (int k = 1; k <= 100; ++k) {
      const double s = k / 100.0;
      dense.push_back((1 - s) * (1 - s) * in + 2 * s * (1 - s) * corner + s * s * out);
    }
  }
  line_to(walk.corners.back());
  std::vector<Eigen::Vector2d> even{dense.front()};
  double since = 0.0;
  for (std::size_t i = 1; i < dense.size(); ++i) {
    since += (dense[i] - dense[i - 1]).norm();
    if (since >= spacing) {
      even.push_back(dense[i]);
      since -= spacing;
    }
  }
  return even;
}

// To the side and back: a bump of 1.6 s, whose fastest turn is amplitude * pi / 1.6 per second.
double head(const Walk& walk, double t) {
  const double period = walk.head_turn_every_s;
  const double phase = std::fmod(t, period);
  const double side = std::fmod(t, 2.0 * period) < period ? 1.0 : -1.0;
  constexpr double kDuration = 1.6;
  const double start = period - kDuration - 0.5;
  if (phase < start || phase > start + kDuration) return 0.0;
  return side * walk.head_turn_rad * 0.5 *
         (1.0 - std::cos(2.0 * M_PI * (phase - start) / kDuration));
}

}  // namespace

Eigen::Isometry3d on_road(const RoadBend& bend, double left_m, double along_m) {
  const double slope = bend.slope(along_m);
  const double norm = std::sqrt(1.0 + slope * slope);
  Attitude a;
  a.position = {along_m - left_m * slope / norm, bend.offset(along_m) + left_m / norm, 0.0};
  a.yaw = std::atan(slope);
  return a.pose();
}

Trajectory drive(const RoadBend& bend, double left_m, const std::function<double(double)>& along_m,
                 double duration_s) {
  constexpr double kLidarHeight = 1.73;
  std::vector<Attitude> knots;
  for (double t = 0.0; t <= duration_s; t += kKnotStep) {
    const double u = along_m(t);
    Attitude a;
    a.position = on_road(bend, left_m, u).translation() + Eigen::Vector3d(0, 0, kLidarHeight);
    a.yaw = std::atan(bend.slope(u));
    knots.push_back(a);
  }
  Trajectory trajectory(knots, 0.0, kKnotStep);
  trajectory.shake = springs;
  return trajectory;
}

Trajectory walk(const Walk& walk) {
  const auto path = rounded(walk, walk.speed_m_s * kKnotStep);
  std::vector<Attitude> knots;
  double yaw = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    // The eyes lead the feet into a turn by about half a second.
    const std::size_t ahead = std::min(i + 3, path.size() - 1);
    const Eigen::Vector2d way = path[ahead] - path[ahead > i ? i : i - 1];
    yaw += std::remainder(std::atan2(way.y(), way.x()) - yaw, 2.0 * M_PI);
    Attitude a;
    a.position = {path[i].x(), path[i].y(), walk.height_m};
    a.yaw = yaw + head(walk, static_cast<double>(i) * kKnotStep);
    knots.push_back(a);
  }
  Trajectory trajectory(knots, 0.0, kKnotStep);
  trajectory.shake = steps;
  return trajectory;
}

}  // namespace sparsight::synthetic
