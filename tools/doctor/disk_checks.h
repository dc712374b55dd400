#pragma once

#include <filesystem>
#include <vector>

#include "hal/result.h"
#include "hal/rig_config.h"
#include "tools/doctor/check.h"

namespace sparsight {

struct DiskObservation {
  double free_bytes = 0.0;
  double bytes_per_s = 0.0;  // sustained, to the medium
};

// Writes `megabytes` into a file of the folder, waits until they are on the medium, and removes it.
Result<DiskObservation> observe_disk(const std::filesystem::path& folder, int megabytes);

// Bytes that a recording of this rig takes each second.
double recording_bytes_per_s(const RigConfig& rig);

// Speed and minutes left.
std::vector<Check> disk_checks(const Result<DiskObservation>& seen, const RigConfig& rig);

}  // namespace sparsight
