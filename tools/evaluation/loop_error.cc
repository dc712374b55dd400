#include "tools/evaluation/loop_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "tools/evaluation/association.h"
#include "tools/evaluation/rotation_angle.h"

namespace sparsight {
namespace {

using TruePoses = std::map<std::uint64_t, Eigen::Isometry3d>;  // by frame

TruePoses true_poses(const SessionLoops& session, const Trajectory& truth) {
  TruePoses poses;
  if (truth.times.empty()) {
    for (const auto& [frame, exposure] : session.exposures) {
      if (frame < truth.poses.size()) poses[frame] = truth.poses[frame];
    }
    return poses;
  }
  std::vector<std::uint64_t> frames;
  std::vector<HostTime> times;
  for (const auto& [frame, exposure] : session.exposures) {
    frames.push_back(frame);
    times.push_back(exposure);
  }
  for (const IndexPair& pair : associate_by_time(times, truth.times, kSimultaneous)) {
    poses[frames[pair.estimate]] = truth.poses[pair.truth];
  }
  return poses;
}

std::size_t submap_of(std::uint64_t frame, const SessionLoops& session) {
  const auto after =
      std::ranges::upper_bound(session.submaps, frame, {}, &SessionLoops::Submap::first_frame);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - session.submaps.begin() - 1));
}

double angle_deg(const Eigen::Isometry3d& T) {
  return rotation_angle_rad(T.linear()) * 180.0 / std::numbers::pi;
}

// Whether the keyframe, an index into those of the session, stands where an earlier one stood.
bool passes_again(std::size_t index, const SessionLoops& session, const TruePoses& truth,
                  const LoopErrorOptions& options) {
  const std::uint64_t frame = session.keyframes[index];
  if (!truth.contains(frame)) return false;
  for (std::size_t earlier = 0; earlier < index; ++earlier) {
    const std::uint64_t before = session.keyframes[earlier];
    if (index - earlier < options.recent_keyframes &&
        submap_of(before, session) == submap_of(frame, session)) {
      return false;  // so are all that follow
    }
    if (!truth.contains(before)) continue;
    const Eigen::Isometry3d T = truth.at(frame).inverse() * truth.at(before);
    if (T.translation().norm() <= options.revisit_m && angle_deg(T) <= options.revisit_deg) {
      return true;
    }
  }
  return false;
}

void judge_submaps(const SessionLoops& session, const std::set<std::size_t>& falsely,
                   LoopError& out) {
  out.submaps = session.submaps.size();
  for (std::size_t i = 0; i < session.submaps.size(); ++i) {
    if (session.submaps[i].part == session.submaps[i].first_frame) continue;
    ++out.joined;
    if (falsely.contains(i)) ++out.joined_falsely;
  }
}

// By how much the loop is off; nothing if a frame's true pose is not known.
std::optional<Eigen::Isometry3d> off_by(const SessionLoops::Loop& loop, const TruePoses& truth) {
  if (!truth.contains(loop.frame) || !truth.contains(loop.before)) return std::nullopt;
  const Eigen::Isometry3d T_frame_before = truth.at(loop.frame).inverse() * truth.at(loop.before);
  return Eigen::Isometry3d(T_frame_before.inverse() * loop.T_frame_before);
}

}  // namespace

Result<LoopError> loop_error(const SessionLoops& session, const Trajectory& truth,
                             const LoopErrorOptions& options) {
  const TruePoses poses = true_poses(session, truth);
  LoopError error{.loops = session.loops.size(),
                  .keyframes = session.keyframes.size(),
                  .with_earlier_map = session.with_earlier_map};
  std::set<std::uint64_t> in_loops;
  std::set<std::size_t> falsely;  // joined sub-maps
  for (const SessionLoops::Loop& loop : session.loops) {
    const auto off = off_by(loop, poses);
    if (!off) {
      return fail(ErrorCode::kOutOfRange,
                  fmt::format("{}: has no pose of frame {} or of frame {}, which are in a loop",
                              truth.source, loop.before, loop.frame));
    }
    const double error_m = off->translation().norm();
    const double error_deg = angle_deg(*off);
    error.max_error_m = std::max(error.max_error_m, error_m);
    error.max_error_deg = std::max(error.max_error_deg, error_deg);
    if (error_m <= options.max_error_m && error_deg <= options.max_error_deg) {
      in_loops.insert(loop.frame);
      continue;
    }
    ++error.false_loops;
    const auto [first, last] =
        std::minmax({submap_of(loop.before, session), submap_of(loop.frame, session)});
    if (first != last) falsely.insert(last);
  }
  for (std::size_t i = 0; i < session.keyframes.size(); ++i) {
    if (!passes_again(i, session, poses, options)) continue;
    ++error.revisits;
    if (in_loops.contains(session.keyframes[i])) ++error.closed;
  }
  judge_submaps(session, falsely, error);
  return error;
}

}  // namespace sparsight
