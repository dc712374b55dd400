#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "hal/device.h"
#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

// Payload of a data packet as received (VLP-16 manual 63-9243 Rev D, p. 55).
struct LidarPacket {
  HostTime arrival;  // kernel's receive stamp
  std::array<std::uint8_t, 1206> payload{};
};

// Payload of a position (telemetry) packet (same manual, p. 60).
struct PositionPacket {
  HostTime arrival;
  std::array<std::uint8_t, 512> payload{};
};

using LidarMessage = std::variant<LidarPacket, PositionPacket>;

struct LidarCounters {
  std::uint64_t packets = 0;
  std::uint64_t positions = 0;
  std::uint64_t refused = 0;  // wrong size or sender
  std::uint64_t dropped = 0;  // by the kernel, for want of buffer space
};

// A LiDAR that delivers packets as they come. Thread-bound.
class Lidar {
 public:
  virtual ~Lidar() = default;
  virtual Result<void> start() = 0;
  // The next packet; nothing if none comes within `patience`.
  virtual std::optional<LidarMessage> read(std::chrono::nanoseconds patience) = 0;
  virtual void stop() = 0;
  virtual DeviceState state() const = 0;
  // The folder under /sys of the hardware that its data come by; "" where there is none.
  virtual std::filesystem::path system_folder() const { return {}; }
  virtual LidarCounters counters() const = 0;
};

// A return with the time of its firing by the sensor's clock.
struct TimedReturn {
  Eigen::Vector3f p_lidar;   // metres; x forward, y left, z up
  float intensity = 0.0F;    // calibrated reflectivity, 0..255
  float azimuth_deg = 0.0F;  // of the firing, [0, 360), clockwise from +x seen from above
  SensorTime fired;
  std::uint16_t ring = 0;  // laser by elevation, 0 the lowest
};

// A data packet read. Sensor times are counted on over the sensor's hours within one epoch.
struct DecodedPacket {
  HostTime arrival;
  SensorTime first_firing;
  SensorTime last_firing;
  std::uint32_t epoch = 0;           // counts jumps of the sensor's clock
  std::uint32_t lost_before = 0;     // packets missing between the one before and this one
  double first_azimuth_deg = 0.0;    // of the first firing, whether or not it has a return
  double turned_deg = 0.0;           // from there to where the next packet begins
  std::vector<TimedReturn> returns;  // in the order of firing; firings without return are left out
};

enum class PpsState : std::uint8_t { kAbsent, kSynchronizing, kLocked, kError };

// What a position packet says of the sensor's clock.
struct LidarClockReport {
  HostTime arrival;
  SensorTime time;  // when the packet was put together; on the same count as DecodedPacket's
  PpsState pps = PpsState::kAbsent;
  bool utc_valid = false;  // the sensor has accepted NMEA time: its hour starts with UTC's
};

struct DecoderCounters {
  std::uint64_t decoded = 0;
  std::uint64_t refused = 0;    // no packet of this sensor
  std::uint64_t reordered = 0;  // older than one already decoded; left out
  std::uint64_t lost = 0;
  std::uint64_t clock_jumps = 0;
};

// Bytes to values, with the memory that needs: hour count, rotation rate, loss. Thread-bound.
class LidarDecoder {
 public:
  virtual ~LidarDecoder() = default;
  // False if the packet is refused or left out (counted); `out` is reused without allocation once
  // it has grown.
  virtual bool decode(const LidarPacket& packet, DecodedPacket& out) = 0;
  virtual std::optional<LidarClockReport> decode(const PositionPacket& packet) = 0;
  virtual DecoderCounters counters() const = 0;
};

}  // namespace sparsight
