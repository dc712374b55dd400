#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/camera.h"
#include "hal/lidar.h"
#include "hal/rig_event.h"
#include "hal/trigger_line.h"

// Every implementation of a device is tried by the same suites. A new one registers itself, in a
// file of its own beside this one:
//
//   const bool kRegistered = add_camera({"Recording", [] {
//     return CameraUnderTest{.device = std::make_unique<ReplayedCamera>(open_made_recording)};
//   }, DeviceNature::kReplayed});
namespace sparsight::contract {

// Delivers some data (ten at least, thousands at most) and then no more.
template <typename Device>
struct DeviceUnderTest {
  std::shared_ptr<void> world;  // what the device stands on and outlives it: a fake, a folder
  std::unique_ptr<Device> device;
  std::function<void()> feed = [] {};  // called after a start: sends what the device receives
  std::function<HostTime()> now = HostClock::now;  // the clock that its patience goes by
};

enum class DeviceNature : std::uint8_t {
  kLive,      // falls silent when no more comes
  kReplayed,  // ends
};

template <typename Device>
struct Implementation {
  std::string name;
  std::function<DeviceUnderTest<Device>()> make;
  DeviceNature nature = DeviceNature::kLive;
};

using CameraUnderTest = DeviceUnderTest<Camera>;
using LidarUnderTest = DeviceUnderTest<Lidar>;
using TriggerLineUnderTest = DeviceUnderTest<TriggerLine>;

struct EventSourceImplementation {
  std::string name;
  std::function<std::unique_ptr<RigEventSource>()> open;
};

template <typename Registered>
std::vector<Registered>& registered() {
  static std::vector<Registered> all;
  return all;
}

inline bool add_camera(Implementation<Camera> implementation) {
  registered<Implementation<Camera>>().push_back(std::move(implementation));
  return true;
}
inline bool add_lidar(Implementation<Lidar> implementation) {
  registered<Implementation<Lidar>>().push_back(std::move(implementation));
  return true;
}
inline bool add_trigger_line(Implementation<TriggerLine> implementation) {
  registered<Implementation<TriggerLine>>().push_back(std::move(implementation));
  return true;
}
inline bool add_event_source(EventSourceImplementation implementation) {
  registered<EventSourceImplementation>().push_back(std::move(implementation));
  return true;
}

// The implementations by their names, as GoogleTest asks for them.
struct NameOfImplementation {
  template <typename Suite>
  std::string operator()(const Suite& suite) const {
    return suite.param.name;
  }
};

// Enough for a loaded machine to send a few packets to itself.
constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(300);

// All that the device has, until it falls silent or ends.
template <typename Device>
auto read_all(Device& device) {
  std::vector<typename decltype(device.read(kPatience))::value_type> all;
  while (auto datum = device.read(kPatience)) all.push_back(std::move(*datum));
  return all;
}

}  // namespace sparsight::contract
