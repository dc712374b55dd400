#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/recording/bytes.h"
#include "hal/rig_event.h"
#include "hal/stamp.h"

namespace sparsight {

// How the LiDAR's clock maps to the host's at a moment.
struct RecordedLidarClock {
  std::chrono::nanoseconds offset{0};  // host time = sensor time + offset
  double drift_ppm = 0.0;
  std::chrono::nanoseconds uncertainty{0};
  std::uint32_t epoch = 0;
  StampQuality quality = StampQuality::kArrival;
  bool operator==(const RecordedLidarClock&) const = default;
};

// What synchronisation made of a frame. For those who look at a recording: a replay does not read
// it, but synchronises anew.
struct RecordedSyncState {
  std::uint32_t frame_sequence = 0;
  std::uint32_t frame_epoch = 0;
  HostTime exposure_middle;
  std::chrono::nanoseconds exposure_uncertainty{0};
  StampQuality exposure_quality = StampQuality::kArrival;
  std::optional<RecordedLidarClock> lidar_clock;
  bool operator==(const RecordedSyncState&) const = default;
};

// sparsight_msgs/Edge, DeviceState, SyncState; the reading is false if the message is not sound.
void append_edge(const Edge& edge, std::vector<std::uint8_t>& out);
bool read_edge(Bytes message, Edge& edge);
void append_device_state(const DeviceStateChange& change, std::vector<std::uint8_t>& out);
bool read_device_state(Bytes message, DeviceStateChange& change);
void append_sync_state(const RecordedSyncState& state, std::vector<std::uint8_t>& out);
bool read_sync_state(Bytes message, RecordedSyncState& state);

}  // namespace sparsight
