#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "drivers/simulated/simulation_options.h"

namespace sparsight::simulated {

// A closed way on the ground that a person walks with the rig in the hand.
struct WalkPlan {
  std::vector<Eigen::Vector2d> corners;  // the way returns from the last to the first
  double start_m = 0.0;                  // from the middle between the first two corners
  double corner_m = 1.2;                 // radius-like: where a corner's arc begins
  double height_m = 1.55;                // of the LiDAR above the ground
  double speed_m_s = 1.05;
  double rest_s = 1.0;         // before the first step
  double ramp_s = 2.0;         // from rest to speed
  double look_yaw_deg = 28.0;  // turns of the head to one side and back
  double look_every_s = 8.0;
};

// Uniform cubic B-spline (de Boor): smooth up to the second derivative, and local.
class SmoothLoop {
 public:
  SmoothLoop() = default;
  // `gain` is added with every lap: 2 pi for a heading.
  SmoothLoop(std::vector<double> controls, double gain)
      : controls_(std::move(controls)), gain_(gain) {}
  double operator()(double laps) const;

 private:
  double control(std::int64_t index) const;
  std::vector<double> controls_;
  double gain_ = 0.0;
};

// Exact pose of the rig at any time: bob, sway and a wandering hand over an even walk. Smooth up to
// the second derivative, except where the rig is carried off. Thread-safe.
class Walk {
 public:
  Walk(const WalkPlan& plan, std::uint64_t seed,
       std::vector<SimulatedFaults::Carried> carried = {});

  // T_world_lidar at seconds since the walk began; the rig is the LiDAR's frame, x ahead, y left, z
  // up.
  Eigen::Isometry3d lidar_pose(double seconds) const;
  double lap_m() const { return lap_m_; }

 private:
  struct Wave {
    double radians_per_s;
    double phase;
    double amplitude;
  };
  using Wander = std::array<Wave, 3>;

  double on_the_walk(double seconds) const;
  double walked_m(double seconds) const;
  double look(double seconds) const;
  double wander(const Wander& waves, double seconds) const;

  WalkPlan plan_;
  double lap_m_ = 0.0;
  SmoothLoop x_;
  SmoothLoop y_;
  SmoothLoop heading_;
  std::array<Wander, 6> wanders_;
  std::uint64_t seed_;
  std::vector<SimulatedFaults::Carried> carried_;
};

}  // namespace sparsight::simulated
