#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace sparsight {

using UtcSecond = std::chrono::sys_time<std::chrono::seconds>;

// The checksum of what stands between '$' and '*': all bytes, exclusive or (NMEA 0183).
std::string nmea_checksum(std::string_view body);

// "$GPRMC,hhmmss,A,...*hh\r\n" for a second that has begun. The VLP-16 takes its minutes and
// seconds from it (manual 63-9243 Rev D, pp. 41-43, 121-125) if the status is A; the position is 0.
std::string gprmc(UtcSecond second);

}  // namespace sparsight
