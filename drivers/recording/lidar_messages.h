#pragma once

#include <vector>

#include "drivers/recording/bytes.h"
#include "hal/lidar.h"

namespace sparsight {

// velodyne_msgs/VelodyneScan of one packet: a packet is on the disk as soon as everything else of
// its time, and keeps its place among the other events.
void append_scan(const LidarPacket& packet, std::vector<std::uint8_t>& out);
// Of any number of packets, as ROS drivers write it. False if it is not sound.
bool read_scan(Bytes message, std::vector<LidarPacket>& packets);

// sparsight_msgs/PositionPacket.
void append_position(const PositionPacket& packet, std::vector<std::uint8_t>& out);
bool read_position(Bytes message, PositionPacket& packet);

}  // namespace sparsight
