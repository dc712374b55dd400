#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

// KITTI odometry's times.txt: seconds, one number per line. `file` is for error messages,
// which count the lines above `text`, too.
Result<std::vector<HostTime>> parse_times_seconds(std::string_view text, const std::string& file,
                                                  std::size_t lines_above = 0);

// KITTI raw's timestamps: "YYYY-MM-DD hh:mm:ss.nnnnnnnnn", one per line, counted from 1970. An
// empty line stands for a frame that was not recorded.
Result<std::vector<std::optional<HostTime>>> parse_timestamps_utc(std::string_view text,
                                                                  const std::string& file);

// Refuses times that do not increase, naming the line.
Result<std::vector<HostTime>> require_increasing(std::vector<HostTime> times,
                                                 const std::string& file,
                                                 std::size_t lines_above = 0);

}  // namespace sparsight
