#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
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

struct Privileges {
  bool nice = false;                           // CAP_SYS_NICE
  bool lock = false;                           // CAP_IPC_LOCK
  std::uint64_t rtprio = 0;                    // RLIMIT_RTPRIO
  std::optional<std::uint64_t> memlock_bytes;  // RLIMIT_MEMLOCK; nothing: unlimited
};

Privileges observe_privileges();
// Of the text of /proc/self/status; for observe_privileges() and its test.
std::uint64_t effective_capabilities(std::string_view status);

// Real-time scheduling, locked memory.
std::vector<Check> privilege_checks(const Privileges& privileges);

Check calibration_check(const RigCalibration& calibration);

}  // namespace sparsight
