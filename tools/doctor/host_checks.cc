#include "tools/doctor/host_checks.h"

#include <fmt/format.h>
#include <linux/capability.h>
#include <sys/resource.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <string>

namespace sparsight {
namespace {

// Of the edge thread, the highest.
constexpr std::uint64_t kNeededPriority = 80;
// Frames, packets and maps of an hour; a guess that errs on the safe side.
constexpr std::uint64_t kNeededLocked = 1ULL << 30U;

constexpr std::string_view kServiceFix =
    "run it as the service does: LimitRTPRIO=95 and LimitMEMLOCK=infinity in its unit, or give "
    "the program the capability: setcap cap_sys_nice,cap_ipc_lock+ep $(command -v sparsight)";

std::uint64_t limit_of(decltype(RLIMIT_RTPRIO) resource) {
  rlimit limit{};
  return ::getrlimit(resource, &limit) == 0 ? limit.rlim_cur : 0;
}

}  // namespace

std::uint64_t effective_capabilities(std::string_view status) {
  constexpr std::string_view kKey = "\nCapEff:\t";
  const std::size_t start = status.find(kKey);
  std::uint64_t bits = 0;
  if (start == std::string_view::npos) return 0;
  const std::string_view hex = status.substr(start + kKey.size());
  std::from_chars(hex.data(), hex.data() + hex.size(), bits, 16);
  return bits;
}

Privileges observe_privileges() {
  std::ifstream file("/proc/self/status");
  const std::string status(std::istreambuf_iterator<char>(file), {});
  const std::uint64_t capabilities = effective_capabilities(status);
  Privileges privileges;
  privileges.nice = (capabilities >> CAP_SYS_NICE & 1U) != 0;
  privileges.lock = (capabilities >> CAP_IPC_LOCK & 1U) != 0;
  privileges.rtprio = limit_of(RLIMIT_RTPRIO);
  const std::uint64_t memlock = limit_of(RLIMIT_MEMLOCK);
  if (memlock != RLIM_INFINITY) privileges.memlock_bytes = memlock;
  return privileges;
}

std::vector<Check> privilege_checks(const Privileges& privileges) {
  Check scheduling{
      "real-time scheduling", Verdict::kOk,
      privileges.nice ? "CAP_SYS_NICE" : fmt::format("RLIMIT_RTPRIO {}", privileges.rtprio), ""};
  if (!privileges.nice && privileges.rtprio < kNeededPriority) {
    scheduling.verdict = Verdict::kWarn;
    scheduling.found += ", 80 needed: it runs, but late under load";
    scheduling.fix = kServiceFix;
  }
  Check memory{"locked memory", Verdict::kOk, "", ""};
  if (privileges.lock || !privileges.memlock_bytes) {
    memory.found = privileges.lock ? "CAP_IPC_LOCK" : "unlimited";
  } else {
    memory.found = fmt::format("RLIMIT_MEMLOCK {} KiB", *privileges.memlock_bytes / 1024);
    if (*privileges.memlock_bytes < kNeededLocked) {
      memory.verdict = Verdict::kWarn;
      memory.found += ": page faults will delay frames";
      memory.fix = kServiceFix;
    }
  }
  return {scheduling, memory};
}

Check calibration_check(const RigCalibration& calibration) {
  const CameraIntrinsics& camera = calibration.camera;
  if (camera.width == 0) {
    return {"calibration", Verdict::kFail, "none",
            "the rig file needs [calibration.camera] and [calibration.T_camera_lidar]"};
  }
  const Eigen::Isometry3d& T = calibration.T_camera_lidar;
  Check check{"calibration", Verdict::kOk,
              fmt::format("{}x{}, fx {:.1f}, LiDAR {:.2f} m from the camera", camera.width,
                          camera.height, camera.fx, T.translation().norm()),
              ""};
  // The LiDAR looks ahead along x, the camera along z.
  if ((T.linear() * Eigen::Vector3d::UnitX()).z() < 0.5) {
    check.verdict = Verdict::kFail;
    check.found += ", looking another way than the camera";
    check.fix =
        "T_camera_lidar takes points of the LiDAR (x ahead) to the camera (z ahead): is "
        "it the inverse, or its quaternion not w first?";
  }
  return check;
}

}  // namespace sparsight
