#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "tools/session/atomic_file.h"
#include "tools/session/ground_truth.h"
#include "tools/session/session.h"

namespace sparsight {

// Ten metres a second along a figure of eight over rolling ground.
inline Eigen::Isometry3d sample_pose(double seconds) {
  const double phase = seconds / 30.0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(60.0 * (1.0 - std::cos(phase)), -1.5 * std::sin(3.0 * phase),
                                       150.0 * std::sin(2.0 * phase));
  pose.linear() = Eigen::AngleAxisd(0.5 * phase, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return pose;
}

inline FrameRecord sample_record(std::uint64_t i) {
  FrameRecord record{.sequence = i,
                     .exposure = HostTime(std::chrono::milliseconds(100) * static_cast<long>(i)),
                     .tracking_time = std::chrono::microseconds(900 + 37 * (i % 23)),
                     .window_time = std::chrono::milliseconds(i % 8 == 0 ? 20 + i % 7 : 0)};
  const double wave = std::sin(0.01 * static_cast<double>(i));
  FrameOutcome& outcome = record.outcome;
  outcome.status =
      i == 0 ? FrameOutcome::Status::kFirst
             : (i % 211 == 210 ? FrameOutcome::Status::kPredicted : FrameOutcome::Status::kTracked);
  outcome.T_world_camera = sample_pose(0.1 * static_cast<double>(i));
  outcome.becomes_keyframe = i % 8 == 0;
  outcome.tracking.points_used = static_cast<int>(700 + 150 * wave) - static_cast<int>(i % 5) * 9;
  outcome.tracking.residual_sigma_grey = 6.0 + 2.0 * wave + 0.1 * static_cast<double>(i % 7);
  outcome.tracking.visible_ratio = 1.0 - 0.025 * static_cast<double>((i + 7) % 8);
  outcome.tracking.attempts = i % 211 == 210 ? 4 : 1;
  if (i % 211 == 210) {
    record.faults.push_back({ErrorCode::kMalformed, "image_0/000210.png: cut off <after> 12 rows"});
  }
  return record;
}

// As if it had been replayed, with a drift of 1 % and, if `truth_file` is given, the truth written
// there.
inline Session sample_session(std::uint64_t frames, const std::filesystem::path& truth_file = {}) {
  Session session;
  session.description.source = "sequences/sample";
  session.description.profile_name = "default";
  session.description.calibration.camera = {.width = 1241, .height = 376, .fx = 700.0, .fy = 700.0};
  session.complete = true;
  session.wall_time = std::chrono::milliseconds(10 * frames);
  std::vector<Eigen::Isometry3d> truth;
  for (std::uint64_t i = 0; i < frames; ++i) {
    const FrameRecord record = sample_record(i);
    session.frames.push_back(figures_of(record));
    for (const Error& fault : record.faults) session.faults.add(i, fault);
    if (record.outcome.becomes_keyframe) session.keyframes.push_back(i);
    truth.push_back(record.outcome.T_world_camera);
    Eigen::Isometry3d estimate = truth.back();
    estimate.translation() *= 1.01;
    session.trajectory.push_back({i, record.exposure, estimate});
  }
  if (!truth_file.empty()) {
    EXPECT_TRUE(write_file(truth_file, format_kitti(truth)));
    session.truth = compare_with_ground_truth(session.trajectory, truth_file).value();
  }
  return session;
}

}  // namespace sparsight
