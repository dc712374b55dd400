#pragma once

#include "tests/tools/evaluation/paths.h"
#include "tools/evaluation/session_loops.h"

// A session that walks round a circle of ten metres, and what it says of its loops.
namespace sparsight::testing {

constexpr std::size_t kFramesRound = 300;
constexpr std::size_t kKeyframeEvery = 5;
constexpr std::chrono::nanoseconds kPeriod{100'000'000};

inline Trajectory round_way(double laps) {
  const auto frames = static_cast<std::size_t>(laps * kFramesRound);
  const double radians_per_frame = 2.0 * M_PI / kFramesRound;
  return timed(
      path(frames,
           [=](double i) {
             const double turn = radians_per_frame * i;
             return pose({0.0, turn, 0.0}, {10.0 * std::sin(turn), 0.0, 10.0 * std::cos(turn)});
           }),
      kPeriod);
}

inline SessionLoops session_on(const Trajectory& truth) {
  SessionLoops session{.submaps = {{.first_frame = 0, .part = 0}}};
  for (std::size_t frame = 0; frame < truth.poses.size(); ++frame) {
    session.exposures[frame] = truth.times[frame];
    if (frame % kKeyframeEvery == 0) session.keyframes.push_back(frame);
  }
  return session;
}

// As measured: off by so much.
inline SessionLoops::Loop loop_of(const Trajectory& truth, std::size_t frame, std::size_t before,
                                  double off_m = 0.0) {
  const Eigen::Isometry3d T = truth.poses[frame].inverse() * truth.poses[before];
  return {
      .frame = frame, .before = before, .T_frame_before = T * Eigen::Translation3d(0, 0, off_m)};
}

}  // namespace sparsight::testing
