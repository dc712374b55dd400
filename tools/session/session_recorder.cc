#include "tools/session/session_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "tools/configuration/profile.h"
#include "tools/session/report.h"
#include "tools/session/session_summary.h"

namespace sparsight {
namespace {

// Images and clouds of the session that is running.
constexpr const char* kKeyframeFile = "keyframes.partial";

std::string kitti_text(const std::vector<TrajectoryPose>& trajectory) {
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(trajectory.size());
  for (const TrajectoryPose& pose : trajectory) poses.push_back(pose.T_world_camera);
  return format_kitti(poses);
}

// Frames that were lost have no line; in KITTI's format, which has no times, all have one.
Trajectory with_its_times(const std::vector<TrajectoryPose>& trajectory) {
  Trajectory result;
  for (const TrajectoryPose& pose : trajectory) {
    if (!pose.known) continue;
    result.poses.push_back(pose.T_world_camera);
    result.times.push_back(pose.exposure);
  }
  return result;
}

std::vector<TrajectoryPose> poses_as_tracked(const std::vector<FrameFigures>& frames) {
  std::vector<TrajectoryPose> trajectory;
  trajectory.reserve(frames.size());
  for (const FrameFigures& frame : frames) {
    trajectory.push_back({frame.sequence, frame.exposure, frame.T_world_camera,
                          frame.status != FrameOutcome::Status::kLost});
  }
  return trajectory;
}

// While it is lost every frame is offered to the window, which takes the first that shows anything.
void forget_refused_keyframes(Session& session) {
  const std::set<std::uint64_t> taken(session.keyframes.begin(), session.keyframes.end());
  for (FrameFigures& frame : session.frames) {
    if (frame.status != FrameOutcome::Status::kLost) continue;
    frame.keyframe = frame.keyframe && taken.contains(frame.sequence);
  }
}

}  // namespace

SessionRecorder::SessionRecorder(std::filesystem::path folder, SessionDescription description,
                                 std::vector<CloudFormat> map, AtomicFile::Appears journal)
    : folder_(std::move(folder)),
      formats_(std::move(map)),
      keyframes_(std::make_shared<PagedKeyframes>()),
      journal_(folder_ / "frames.csv", journal) {
  if (journal == AtomicFile::Appears::kAtOnce) {
    poses_.emplace(folder_ / "trajectory.tum", journal);
    poses_->stream() << kTumHeader;
  }
  session_.description = std::move(description);
  if (!formats_.empty()) {
    map_.emplace(VoxelMapConfig{});
    composer_.emplace(*map_);
  }
  journal_.stream() << frames_csv_header();
}

Result<void> SessionRecorder::begin() {
  if (session_.description.config.loop.enabled && !keyframes_->writes()) {
    auto file = KeyframeFile::create(folder_ / kKeyframeFile);
    if (!file) return tl::unexpected(file.error());
    keyframes_->write_to(std::move(*file));
  }
  if (std::filesystem::exists(folder_ / "session.json")) return {};
  return write_file(folder_ / "session.json", session_json(session_, {}));
}

std::vector<Error> SessionRecorder::add(const FrameRecord& record) {
  session_.frames.push_back(figures_of(record));
  journal_.stream() << frames_csv_line(session_.frames.back());
  journal_.flush();
  if (poses_ && record.outcome.status != FrameOutcome::Status::kLost) {
    poses_->stream() << tum_line(record.exposure, record.outcome.T_world_camera);
    poses_->flush();
  }
  std::vector<Error> news;
  for (const Error& fault : record.faults) {
    if (session_.faults.add(record.sequence, fault)) news.push_back(fault);
  }
  return news;
}

void SessionRecorder::add(const RetiredKeyframe& keyframe) {
  session_.keyframes.push_back(keyframe.sequence);
  if (keyframe.begins_submap || session_.submaps.empty()) {
    session_.submaps.push_back({.first_keyframe = keyframe.sequence, .part = keyframe.sequence});
  }
  ++session_.submaps.back().keyframes;
  if (!composer_ || session_.description.config.loop.enabled) return;
  composer_->add({.T_world_camera = keyframe.T_world_camera,
                  .camera = session_.description.calibration.camera,
                  .cloud_camera = keyframe.cloud_camera});
}

void SessionRecorder::compose_map(const std::vector<PlacedKeyframe>& placed) {
  for (const PlacedKeyframe& keyframe : placed) {
    auto bulk = keyframes_->get(keyframe.stored);
    if (!bulk) continue;
    composer_->add({.T_world_camera = keyframe.T_world_camera,
                    .camera = keyframe.camera,
                    .cloud_camera = std::move(bulk->cloud_camera)});
  }
  composer_->finish();
}

void SessionRecorder::note_keyframes() {
  const std::size_t lost = keyframes_->not_kept() + keyframes_->damaged();
  if (lost == 0 || !session_.description.config.loop.enabled) return;
  session_.notes.push_back(
      fmt::format("{} keyframes could not be kept or read back; they are missing in the map: {}",
                  lost, keyframes_->message()));
}

void SessionRecorder::end(ReplayTrajectories trajectories, std::chrono::nanoseconds wall_time) {
  if (trajectories.odometry.empty()) trajectories.odometry = poses_as_tracked(session_.frames);
  if (trajectories.corrected.empty()) {
    session_.trajectory = std::move(trajectories.odometry);
  } else {
    session_.trajectory = std::move(trajectories.corrected);
    session_.odometry = std::move(trajectories.odometry);
  }
  forget_refused_keyframes(session_);
  if (composer_) compose_map(trajectories.placed);
  note_keyframes();
  session_.wall_time = wall_time;
  session_.complete = !session_.broke_off;
}

Result<void> SessionRecorder::write() {
  if (map_) session_.map_points = map_->points().size();
  const SessionSummary summary = summarize(session_);
  const std::pair<const char*, std::string> files[] = {
      {"trajectory.kitti", kitti_text(session_.trajectory)},
      {"trajectory.tum", format_tum(with_its_times(session_.trajectory))},
      {"profile.toml", describe_profile(session_.description.config)},
      {"report.html", report_html(session_, summary)}};
  for (const auto& [name, content] : files) {
    if (auto written = write_file(folder_ / name, content); !written) return written;
  }
  if (auto written = write_odometry(); !written) return written;
  return journal_.commit().and_then([&] { return write_map(); }).and_then([&] {
    std::error_code error;  // nothing needs it any more
    std::filesystem::remove(folder_ / kKeyframeFile, error);
    return write_file(folder_ / "session.json", session_json(session_, summary));
  });
}

Result<void> SessionRecorder::write_odometry() {
  const std::filesystem::path file = folder_ / "odometry.tum";
  if (!session_.odometry.empty()) {
    return write_file(file, format_tum(with_its_times(session_.odometry)));
  }
  std::error_code error;  // an earlier session's would not be this one's
  std::filesystem::remove(file, error);
  return {};
}

Result<void> SessionRecorder::write_map() {
  for (const CloudFormat format : kCloudFormats) {
    const std::filesystem::path file = folder_ / fmt::format("map.{}", name_of(format));
    if (std::ranges::find(formats_, format) == formats_.end()) {
      std::error_code error;  // an earlier session's map would not be this one's
      std::filesystem::remove(file, error);
    } else if (auto written =
                   write_cloud(file, format, map_->points(), session_.description.full_intensity);
               !written) {
      return written;
    }
  }
  return {};
}

}  // namespace sparsight
