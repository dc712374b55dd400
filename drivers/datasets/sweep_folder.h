#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "drivers/datasets/firing_time.h"
#include "hal/result.h"

namespace sparsight {

// velodyne_points of a KITTI raw drive: scans as measured, each with the times of its turn. Some
// drives miss some scans.
struct SweepFolder {
  struct Times {
    std::optional<HostTime> start;
    std::optional<HostTime> trigger;  // facing forward
    std::optional<HostTime> end;
  };
  std::filesystem::path folder;
  std::map<std::uint64_t, std::filesystem::path> scans;  // by number; not empty
  std::map<std::uint64_t, Times> times;                  // by number

  std::optional<HostTime> trigger(std::uint64_t number) const;
  // The turn of a scan; refused if unknown, or too far from the exposure to go with it.
  Result<SweepTiming> timing(std::uint64_t number, HostTime exposure) const;
  // The scan that triggered the image which arrived then. For drives whose streams are not numbered
  // alike (..._extract).
  std::optional<std::uint64_t> nearest(HostTime arrival) const;
};

// timestamps_start.txt and timestamps_end.txt must be there, timestamps.txt need not.
Result<SweepFolder> read_sweep_folder(const std::filesystem::path& folder);

}  // namespace sparsight
