#include "tools/doctor/examination.h"

#include <future>
#include <iterator>

#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/v4l2/v4l2_camera.h"
#include "drivers/vlp16/udp_lidar.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "tools/doctor/camera_checks.h"
#include "tools/doctor/disk_checks.h"
#include "tools/doctor/event_collector.h"
#include "tools/doctor/frame_examination.h"
#include "tools/doctor/host_checks.h"
#include "tools/doctor/lidar_checks.h"
#include "tools/doctor/trigger_checks.h"

namespace sparsight {
namespace {

void append(std::vector<Check>& checks, std::vector<Check> more) {
  checks.insert(checks.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

template <typename Function>
std::future<std::vector<Check>> at_the_same_time(Function function) {
  return std::async(std::launch::async, std::move(function));
}

}  // namespace

RigDevices live_devices(const RigConfig& rig) {
  RigDevices devices;
  devices.camera = std::make_unique<V4l2Camera>(rig.camera);
  devices.lidar = std::make_unique<UdpLidar>(rig.lidar);
  devices.decoder = std::make_unique<Vlp16Decoder>(rig.lidar);
  devices.trigger = std::make_unique<GpioTriggerLine>(rig.trigger);
  return devices;
}

std::vector<Check> examine(RigDevices& devices, const RigConfig& rig,
                           const Examination& examination) {
  std::vector<std::future<std::vector<Check>>> running;
  const auto duration = examination.duration;
  EventCollector collector;
  const EventSink collect = [&](RigEvent event) { collector.add(std::move(event)); };
  if (devices.camera) {
    running.push_back(at_the_same_time([&] {
      return camera_checks(observe_camera(*devices.camera, duration, HostClock::now, collect),
                           rig.camera);
    }));
  }
  if (devices.lidar && devices.decoder) {
    running.push_back(at_the_same_time([&] {
      return lidar_checks(
          observe_lidar(*devices.lidar, *devices.decoder, duration, HostClock::now, collect), rig);
    }));
  }
  if (devices.trigger) {
    running.push_back(at_the_same_time([&] {
      return trigger_checks(observe_trigger(*devices.trigger, duration, HostClock::now, collect),
                            rig);
    }));
  }
  std::vector<Check> checks;
  for (auto& device : running) append(checks, device.get());
  checks.push_back(calibration_check(rig.calibration));
  append(checks, examine_events(collector.take(), rig, examination.overlay));
  // After the devices: writing would disturb them.
  append(checks, disk_checks(observe_disk(examination.folder, examination.disk_megabytes), rig));
  append(checks, privilege_checks(observe_privileges()));
  return checks;
}

}  // namespace sparsight
