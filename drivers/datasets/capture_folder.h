#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

// Whose seconds since 1970 the times of the images are.
enum class CaptureClock : std::uint8_t {
  kCapture,  // the clock of the machine that captured the packets
  kLidar,    // the LiDAR's own, which PPS and NMEA have set to UTC
};

// What was recorded by other means: a capture of the LiDAR's packets (FOLDER/*.pcap or *.pcapng),
// images (FOLDER/images, in the order of their names: of numbers in them, by value), the middle of
// each exposure (FOLDER/times.txt, a line each, "# clock: lidar" above them where it is), and the
// rig's description (FOLDER/rig.toml).
struct CaptureFolder {
  std::filesystem::path capture;
  std::filesystem::path rig;
  std::filesystem::path times_file;
  std::vector<std::filesystem::path> images;
  std::vector<HostTime> exposures;  // as many, increasing
  CaptureClock clock = CaptureClock::kCapture;
};

// Whether a person would take it for one; parts may be missing.
bool is_capture_folder(const std::filesystem::path& folder);
Result<CaptureFolder> index_capture_folder(const std::filesystem::path& folder);

}  // namespace sparsight
