#include "tools/session/live_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/session/frame_figures.h"

namespace sparsight {
namespace {

using Json = nlohmann::ordered_json;

double megabytes(std::uint64_t bytes) { return 1e-6 * static_cast<double>(bytes); }

// Metres, and a quaternion.
Json json_of(const Eigen::Isometry3d& T) {
  const Eigen::Vector3d t = T.translation();
  const Eigen::Quaterniond q(T.linear());
  return {{"position_m", {t.x(), t.y(), t.z()}},
          {"orientation_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

Json json_of(const LatencySnapshot& latency) {
  return {{"count", latency.count},
          {"p50", to_milliseconds(latency.percentile(0.5))},
          {"p99", to_milliseconds(latency.percentile(0.99))},
          {"max_ever", to_milliseconds(latency.max)}};
}

Json json_of(const DeviceStatus& device) {
  Json json = {{"state", name_of(device.state)},
               {"events", device.events},
               {"lost", device.lost},
               {"not_synchronized", device.not_synchronized},
               {"not_recorded", device.not_recorded}};
  if (!device.message.empty()) json["message"] = device.message;
  return json;
}

Json json_of(const SyncState& sync) {
  return {
      {"locked", sync.camera.locked},
      {"edges_matched", sync.camera.edges_matched},
      {"edges_lost", sync.camera.edges_lost},
      {"frames_lost", sync.camera.frames_lost},
      {"frames_late", sync.camera.frames_late},
      {"frames_estimated", sync.camera.frames_estimated},
      {"frames_unsynchronized", sync.camera.frames_unsynchronized},
      {"frames_without_returns", sync.frames_without_returns},
      {"packets_lost", sync.packets.lost},
      {"lidar_clock_uncertainty_us", 1e-3 * static_cast<double>(sync.lidar.uncertainty.count())}};
}

Json json_of(const RecorderReport& report) {
  Json json = {
      {"state", name_of(report.state)},           {"bytes", report.bytes_written},
      {"queued_bytes", report.queued_bytes},      {"most_queued_bytes", report.most_queued_bytes},
      {"frames_dropped", report.frames_dropped},  {"packets_dropped", report.packets_dropped},
      {"preview_dropped", report.preview_dropped}};
  if (!report.message.empty()) json["message"] = report.message;
  return json;
}

std::string device_word(const char* name, const DeviceStatus& device) {
  return fmt::format("{} {}", name, name_of(device.state));
}

std::string recording_words(const std::optional<RecorderReport>& recorder) {
  if (!recorder) return "not recording";
  if (recorder->state == RecorderState::kRecording) {
    return fmt::format("recorded {:.0f} MB", megabytes(recorder->bytes_written));
  }
  return fmt::format("recording {}", name_of(recorder->state));
}

}  // namespace

const char* name_of(RecorderState state) {
  switch (state) {
    case RecorderState::kRecording:
      return "recording";
    case RecorderState::kFinished:
      return "finished";
    case RecorderState::kFloorReached:
      return "ended: little space is left";
    case RecorderState::kDiskFull:
      return "ended: the disk is full";
    case RecorderState::kDiskFailed:
      return "ended: the disk failed";
  }
  return "unknown";
}

std::string live_line(const LiveView& view) {
  const LiveStatus& now = view.now;
  const LatencySnapshot pose = now.exposure_to_pose.since(view.before.exposure_to_pose);
  const LatencySnapshot tracking = now.tracking_time.since(view.before.tracking_time);
  std::string line = fmt::format(
      "{:6.1f} s  {}  {} frames  pose after {:.1f}/{:.1f} ms  tracking {:.1f}/{:.1f} ms  {} "
      "keyframes  missed {}  dropped {}  {}  {}, {}, {}  {:.0f} % CPU  {:.0f} MB",
      to_seconds(now.running), name_of(now.state), now.frames,
      to_milliseconds(pose.percentile(0.5)), to_milliseconds(pose.percentile(0.99)),
      to_milliseconds(tracking.percentile(0.5)), to_milliseconds(tracking.percentile(0.99)),
      now.keyframes, now.deadlines_missed, now.frames_dropped + now.events_dropped(),
      recording_words(view.recorder), device_word("camera", now.camera),
      device_word("lidar", now.lidar), device_word("trigger", now.trigger), 100.0 * view.cpu_share,
      megabytes(view.resident_bytes));
  if (now.shed != Shed::kNothing) {
    line += fmt::format("  overloaded: left out up to {}", name_of(now.shed));
  }
  return line;
}

std::string live_json(const LiveView& view) {
  const LiveStatus& now = view.now;
  const LiveStatus& before = view.before;
  Json json = {
      {"running_s", to_seconds(now.running)},
      {"state", name_of(now.state)},
      {"frames", now.frames},
      {"tracked", now.frames_tracked},
      {"predicted", now.frames_predicted},
      {"lost", now.frames_lost},
      {"keyframes", now.keyframes},
      {"frames_dropped", now.frames_dropped},
      {"records_dropped", now.records_dropped},
      {"deadlines_missed", now.deadlines_missed},
      {"phase_locked", now.phase_locked},
      {"exposure_to_pose_ms", json_of(now.exposure_to_pose.since(before.exposure_to_pose))},
      {"arrival_to_pose_ms", json_of(now.arrival_to_pose.since(before.arrival_to_pose))},
      {"wake_up_ms", json_of(now.wake_up.since(before.wake_up))},
      {"tracking_ms", json_of(now.tracking_time.since(before.tracking_time))},
      {"window_ms", json_of(now.window_time.since(before.window_time))},
      {"shed", name_of(now.shed)},
      {"left_out",
       {{"previews", now.previews_left_out},
        {"loop_searches", now.searches_left_out},
        {"windows_shortened", now.windows_shortened},
        {"frames_coarse", now.frames_coarse},
        {"pose_searches_cut", now.pose_searches_cut}}},
      {"camera", json_of(now.camera)},
      {"lidar", json_of(now.lidar)},
      {"trigger", json_of(now.trigger)},
      {"sync", json_of(now.sync)},
      {"cpu_share", view.cpu_share},
      {"resident_bytes", view.resident_bytes}};
  if (now.first_pose) json["first_pose_s"] = to_seconds(*now.first_pose);
  if (now.pose) {
    json["submap"] = now.pose->submap;
    json["T_odom_camera"] = json_of(now.pose->T_world_camera);
    if (in_its_place(now.map, now.pose->submap)) {
      json["T_map_camera"] = json_of(now.map.T_map_world * now.pose->T_world_camera);
      json["T_map_odom"] = json_of(now.map.T_map_world);
    }
  }
  json["recorder"] = view.recorder ? json_of(*view.recorder) : Json(nullptr);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sparsight
