#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace sparsight {

// What is used of an NMEA 0183 sentence "$GPRMC,hhmmss[.sss],A,...*hh", the only one a VLP-16
// understands (manual 63-9243 Rev D, p. 41-43).
struct Gprmc {
  std::chrono::nanoseconds time_of_day{0};  // UTC
  bool receiver_valid = false;              // status A
};

// Nothing unless it is such a sentence, whole, with its checksum right. What follows the line end
// or a zero byte is ignored.
std::optional<Gprmc> parse_gprmc(std::string_view text);

}  // namespace sparsight
