#include "drivers/recording/lidar_messages.h"

#include <algorithm>

#include "drivers/recording/ros_header.h"

namespace sparsight {

void append_scan(const LidarPacket& packet, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_header({packet.arrival, kLidarFrame}, writer);
  writer.length(1);
  write_stamp(packet.arrival, writer);
  writer.array(packet.payload);
}

bool read_scan(Bytes message, std::vector<LidarPacket>& packets) {
  packets.clear();
  CdrReader reader(message);
  read_header(reader);
  const std::uint32_t count = reader.length();
  for (std::uint32_t i = 0; i < count && reader.ok(); ++i) {
    LidarPacket packet{read_stamp(reader)};
    const Bytes payload = reader.array(packet.payload.size());
    if (!reader.ok()) break;
    std::ranges::copy(payload, packet.payload.begin());
    packets.push_back(packet);
  }
  return reader.ok();
}

void append_position(const PositionPacket& packet, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  writer.number(std::int64_t{packet.arrival.time_since_epoch().count()});
  writer.array(packet.payload);
}

bool read_position(Bytes message, PositionPacket& packet) {
  CdrReader reader(message);
  packet.arrival = HostTime(std::chrono::nanoseconds(reader.number<std::int64_t>()));
  const Bytes payload = reader.array(packet.payload.size());
  if (!reader.ok()) return false;
  std::ranges::copy(payload, packet.payload.begin());
  return true;
}

}  // namespace sparsight
