#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hal/result.h"
#include "hal/rig_config.h"
#include "hal/rig_event.h"
#include "tools/playback/device_player.h"

namespace sparsight {

// The kernel's interfaces that a rig's drivers read, from their other side.
struct RigDeviceNames {
  std::string camera = "/dev/video10";       // which the drivers read
  std::string camera_output;                 // which is written to; "": the same node
  std::string chip = "/dev/gpiochip0";       // of gpio-sim
  std::string lidar_address = "127.0.0.1";   // where packets are sent to
  std::string sensor_address = "127.0.0.1";  // where they come from
};

// The rig of a recording with the devices that it is played into in the place of its own. The
// camera's settings are left out: a loopback has none.
RigConfig rig_on_devices(RigConfig recorded, const RigDeviceNames& names);

// Opens all of them. `like` is any frame of the recording.
Result<DevicePlayer::Devices> open_rig_devices(const RigConfig& rig, const RigDeviceNames& names,
                                               const CameraFrame& like);

}  // namespace sparsight
