#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "hal/camera.h"
#include "hal/lidar.h"
#include "hal/rig_config.h"
#include "hal/trigger_line.h"
#include "tools/doctor/check.h"

namespace sparsight {

// The rig's devices; one that is absent here is not examined.
struct RigDevices {
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Lidar> lidar;
  std::unique_ptr<LidarDecoder> decoder;
  std::unique_ptr<TriggerLine> trigger;
};

// The live ones that the configuration names.
RigDevices live_devices(const RigConfig& rig);

struct Examination {
  std::chrono::nanoseconds duration = std::chrono::seconds(3);
  std::filesystem::path folder = ".";  // where recordings would go
  int disk_megabytes = 64;
  std::filesystem::path overlay;  // picture of the LiDAR on the image; "" for none
};

// All devices are watched at the same time, each by a thread; then what they delivered is put
// together as it would be in a session.
std::vector<Check> examine(RigDevices& devices, const RigConfig& rig,
                           const Examination& examination);

}  // namespace sparsight
