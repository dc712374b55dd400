#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "hal/rig_event.h"

// A rig's events of some seconds, small and quick to make: frames with noise at 30 Hz with both
// edges of their exposures, packets at 754 Hz, a position packet and a PPS edge every second.
namespace sparsight::testing {

struct MadeRig {
  int width = 40;
  int height = 30;
  PixelFormat format = PixelFormat::kGrey8;
  std::uint32_t seed = 1;
};

inline HostTime host_ns(std::int64_t ns) { return HostTime(std::chrono::nanoseconds(ns)); }

inline std::shared_ptr<CameraFrame> made_frame(const MadeRig& rig, std::uint32_t sequence,
                                               HostTime exposure, std::mt19937& random) {
  auto frame = std::make_shared<CameraFrame>();
  frame->sequence = sequence;
  frame->epoch = 3;
  frame->driver_time = exposure + std::chrono::microseconds(5000);
  frame->arrival = exposure + std::chrono::microseconds(12345);
  frame->exposure = std::chrono::microseconds(4000);
  frame->format = rig.format;
  frame->width = rig.width;
  frame->height = rig.height;
  frame->stride_bytes = rig.width;
  frame->bytes.resize(static_cast<std::size_t>(rig.width) * rig.height);
  // Like a wall with a sensor's noise: some bits of a byte repeat, some do not.
  for (std::uint8_t& byte : frame->bytes) byte = static_cast<std::uint8_t>(100 + random() % 8);
  return frame;
}

inline std::vector<RigEvent> made_events(std::chrono::milliseconds duration,
                                         const MadeRig& rig = {}) {
  std::mt19937 random(rig.seed);
  std::vector<RigEvent> events;
  const std::int64_t start = 1'000'000'000'000;
  const std::int64_t end = start + std::chrono::nanoseconds(duration).count();
  events.emplace_back(
      DeviceStateChange{DeviceKind::kCamera, DeviceState::kStreaming, host_ns(start)});
  std::uint32_t sequence = 0;
  for (std::int64_t t = start; t < end; t += 33'333'333) {
    events.emplace_back(Edge{EdgeLine::kExposure, true, host_ns(t)});
    events.emplace_back(Edge{EdgeLine::kExposure, false, host_ns(t + 4'000'000)});
    events.emplace_back(
        std::shared_ptr<const CameraFrame>(made_frame(rig, sequence++, host_ns(t), random)));
  }
  for (std::int64_t t = start + 7; t < end; t += 1'327'104) {
    LidarPacket packet{host_ns(t)};
    for (std::uint8_t& byte : packet.payload) byte = static_cast<std::uint8_t>(random() % 16);
    events.emplace_back(packet);
  }
  for (std::int64_t t = start + 500'000; t < end; t += 1'000'000'000) {
    PositionPacket packet{host_ns(t)};
    packet.payload[200] = static_cast<std::uint8_t>(t / 1'000'000'000);
    events.emplace_back(packet);
    events.emplace_back(Edge{EdgeLine::kPps, true, host_ns(t + 1)});
  }
  std::ranges::stable_sort(
      events, [](const RigEvent& a, const RigEvent& b) { return arrival_of(a) < arrival_of(b); });
  return events;
}

inline bool same(const CameraFrame& a, const CameraFrame& b) {
  return a.sequence == b.sequence && a.epoch == b.epoch && a.driver_time == b.driver_time &&
         a.arrival == b.arrival && a.exposure == b.exposure && a.damaged == b.damaged &&
         a.format == b.format && a.width == b.width && a.height == b.height &&
         a.stride_bytes == b.stride_bytes && a.bytes == b.bytes;
}

// Bit for bit, in every field.
inline bool same(const RigEvent& a, const RigEvent& b) {
  if (a.index() != b.index()) return false;
  if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&a)) {
    return same(**frame, *std::get<std::shared_ptr<const CameraFrame>>(b));
  }
  if (const auto* edge = std::get_if<Edge>(&a)) {
    const auto& other = std::get<Edge>(b);
    return edge->line == other.line && edge->rising == other.rising && edge->time == other.time;
  }
  if (const auto* packet = std::get_if<LidarPacket>(&a)) {
    const auto& other = std::get<LidarPacket>(b);
    return packet->arrival == other.arrival && packet->payload == other.payload;
  }
  if (const auto* packet = std::get_if<PositionPacket>(&a)) {
    const auto& other = std::get<PositionPacket>(b);
    return packet->arrival == other.arrival && packet->payload == other.payload;
  }
  const auto& change = std::get<DeviceStateChange>(a);
  const auto& other = std::get<DeviceStateChange>(b);
  return change.device == other.device && change.state == other.state && change.at == other.at;
}

// How many events two lists have in common from their start on.
inline std::size_t agreeing(const std::vector<RigEvent>& a, const std::vector<RigEvent>& b) {
  std::size_t count = 0;
  while (count < a.size() && count < b.size() && same(a[count], b[count])) ++count;
  return count;
}

}  // namespace sparsight::testing
