#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "realtime/executor/latency_histogram.h"
#include "realtime/pipeline/device_stage.h"
#include "realtime/pipeline/live_messages.h"
#include "realtime/pipeline/overload.h"
#include "realtime/sync/synchronizer.h"

namespace sparsight {

enum class LiveState : std::uint8_t {
  kWaiting,        // no frame has come from the camera yet
  kSynchronizing,  // frames come, but none whose exposure is known
  kTracking,
  kLost,          // frames cannot be tracked: where the rig is is not known
  kRelocalizing,  // tracking goes on in a sub-map; where that lies in the map is not known yet
  kBlind,         // frames with a known exposure have stopped coming
};

// All there is to know of a live run at one moment.
struct LiveStatus {
  HostTime at;
  std::chrono::nanoseconds running{0};
  LiveState state = LiveState::kWaiting;
  DeviceStatus camera;
  DeviceStatus lidar;
  DeviceStatus trigger;
  SyncState sync;
  std::optional<LivePose> pose;  // nothing while lost
  MapPlace map;
  std::optional<std::chrono::nanoseconds> first_pose;  // since the sensors' first event

  std::uint64_t frames = 0;
  std::uint64_t frames_tracked = 0;
  std::uint64_t frames_predicted = 0;
  std::uint64_t frames_lost = 0;
  std::uint64_t frames_dropped = 0;
  std::uint64_t keyframes = 0;
  std::uint64_t deadlines_missed = 0;
  std::uint64_t records_dropped = 0;
  bool phase_locked = false;

  Shed shed = Shed::kNothing;
  std::uint64_t previews_left_out = 0;
  std::uint64_t searches_left_out = 0;
  std::uint64_t windows_shortened = 0;
  std::uint64_t frames_coarse = 0;
  std::uint64_t pose_searches_cut = 0;

  // Since the start.
  LatencySnapshot wake_up;
  LatencySnapshot tracking_time;
  LatencySnapshot window_time;
  LatencySnapshot exposure_to_pose;
  LatencySnapshot arrival_to_pose;

  std::uint64_t events_dropped() const {
    return camera.not_recorded + lidar.not_recorded + trigger.not_recorded;
  }
};

const char* name_of(LiveState state);
const char* name_of(Shed shed);
const char* name_of(DeviceState state);

}  // namespace sparsight
