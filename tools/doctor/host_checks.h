#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/calibration.h"
#include "tools/doctor/check.h"

namespace sparsight {

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
