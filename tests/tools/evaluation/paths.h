#pragma once

#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <vector>

#include "tools/evaluation/trajectory.h"

// Paths with known errors, for the tests of this folder.
namespace sparsight::testing {

inline Eigen::Isometry3d pose(const Eigen::Vector3d& rotation_vector,
                              const Eigen::Vector3d& translation) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = rotation_vector.norm();
  if (angle > 0.0) {
    T.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
  }
  T.translation() = translation;
  return T;
}

inline Trajectory path(std::size_t frames, const std::function<Eigen::Isometry3d(double)>& at) {
  Trajectory trajectory{.source = "made up"};
  for (std::size_t i = 0; i < frames; ++i) {
    trajectory.poses.push_back(at(static_cast<double>(i)));
  }
  return trajectory;
}

// Forward along z. A step this hair above one metre makes the first frame further than 100 m the
// one at 100 m, so that errors per nominal length are exact.
constexpr double kStep_m = 1.0 + 1e-12;

inline Trajectory straight_path(std::size_t frames, double stretch = 1.0) {
  return path(frames, [=](double i) {
    return pose(Eigen::Vector3d::Zero(), {0.0, 0.0, stretch * kStep_m * i});
  });
}

// A drive with bends and hills whose straight-line motion nowhere repeats.
inline Trajectory winding_path(std::size_t frames) {
  return path(frames, [](double i) {
    return pose({0.02 * std::sin(0.05 * i), 0.5 * std::sin(0.013 * i), 0.01 * std::cos(0.1 * i)},
                {30.0 * std::sin(0.02 * i), 0.5 * std::cos(0.03 * i), 0.9 * i});
  });
}

inline Trajectory moved(const Eigen::Isometry3d& T, Trajectory trajectory) {
  for (Eigen::Isometry3d& each : trajectory.poses) {
    each = T * each;
  }
  return trajectory;
}

// Times i * period, for paths that are to be paired by time.
inline Trajectory timed(Trajectory trajectory, std::chrono::nanoseconds period,
                        std::chrono::nanoseconds start = {}) {
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    trajectory.times.emplace_back(start + static_cast<std::int64_t>(i) * period);
  }
  return trajectory;
}

inline double arbitrary_real(double largest) {
  return *rc::gen::inRange(-1'000'000, 1'000'001) * 1e-6 * largest;
}

inline Eigen::Vector3d arbitrary_vector(double largest) {
  const double x = arbitrary_real(largest);
  const double y = arbitrary_real(largest);
  return {x, y, arbitrary_real(largest)};
}

inline Eigen::Isometry3d arbitrary_pose(double farthest_m) {
  const Eigen::Vector3d rotation = arbitrary_vector(3.0);
  return pose(rotation, arbitrary_vector(farthest_m));
}

// About a metre forward per frame, with turns.
inline Trajectory arbitrary_path(std::size_t frames) {
  Trajectory trajectory{.source = "arbitrary"};
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < frames; ++i) {
    trajectory.poses.push_back(T);
    const Eigen::Vector3d turn = arbitrary_vector(0.1);
    T = T * pose(turn, Eigen::Vector3d(0.0, 0.0, 1.0) + arbitrary_vector(0.3));
  }
  return trajectory;
}

}  // namespace sparsight::testing
