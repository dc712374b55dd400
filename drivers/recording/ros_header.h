#pragma once

#include <string_view>

#include "drivers/recording/cdr.h"
#include "hal/time.h"

namespace sparsight {

// builtin_interfaces/Time: whole seconds in 32 bits, so that host times of ±68 years pass exactly.
void write_stamp(HostTime time, CdrWriter& writer);
HostTime read_stamp(CdrReader& reader);

// std_msgs/Header.
struct RosHeader {
  HostTime stamp;
  std::string_view frame_id;
};
void write_header(const RosHeader& header, CdrWriter& writer);
RosHeader read_header(CdrReader& reader);

// Frames as ROS tools name them; "velodyne" is what the sensor's ROS driver calls its own.
// As REP-105 names them: docs/frames.md.
inline constexpr std::string_view kMapFrame = "map";
inline constexpr std::string_view kOdometryFrame = "odom";
inline constexpr std::string_view kCameraFrame = "camera";
inline constexpr std::string_view kLidarFrame = "velodyne";

}  // namespace sparsight
