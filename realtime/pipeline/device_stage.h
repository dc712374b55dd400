#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "hal/camera.h"
#include "hal/lidar.h"
#include "hal/rig_event.h"
#include "hal/trigger_line.h"
#include "realtime/executor/spsc_queue.h"
#include "realtime/pipeline/stage_thread.h"

namespace sparsight {

struct DeviceStatus {
  DeviceState state = DeviceState::kStopped;
  std::uint64_t events = 0;
  std::uint64_t lost = 0;              // by the device or the kernel, as far as they tell
  std::uint64_t not_synchronized = 0;  // dropped, as the synchronisation was behind
  std::uint64_t not_recorded = 0;      // dropped, as the recording was behind
  std::string message;                 // why it did not start
};

// One device on a thread of its own: what it delivers goes into two queues, one to be synchronised
// and one to be recorded, so that neither holds up the other or the device. A device that does not
// start is tried again every second; what becomes of it is an event too, and never ends the thread.
class DeviceStage {
 public:
  struct Device {
    DeviceKind kind;
    std::function<Result<void>()> start;
    std::function<std::optional<RigEvent>()> read;  // waits a moment
    std::function<void()> stop;
    std::function<DeviceState()> state;
    std::function<std::uint64_t()> lost = {};  // so far; none is told of where it is not given
    std::function<void()> streams = {};        // called, if given, whenever it has begun to stream
  };

  DeviceStage(Device device, std::size_t queue_events, ThreadSettings settings,
              SetupRemarks& remarks);

  void start();
  void stop() { thread_.stop(); }
  // A recording that has ended; never of a live device.
  bool ended() const { return state_.load() == DeviceState::kEnded; }

  SpscQueue<RigEvent>& to_sync() { return to_sync_; }
  SpscQueue<RigEvent>& to_recorder() { return to_recorder_; }
  const StageThread& thread() const { return thread_; }
  DeviceStatus status() const;

 private:
  void run();
  bool begin();
  void put(const RigEvent& event);
  void note(DeviceState state);
  void say(const std::string& message);

  Device device_;
  SpscQueue<RigEvent> to_sync_;
  SpscQueue<RigEvent> to_recorder_;
  std::atomic<DeviceState> state_{DeviceState::kStopped};
  std::atomic<std::uint64_t> events_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<std::uint64_t> not_synchronized_{0};
  std::atomic<std::uint64_t> not_recorded_{0};
  mutable std::mutex mutex_;  // guards the message
  std::string message_;
  StageThread thread_;
};

DeviceStage::Device stage_device(std::shared_ptr<Camera> camera);
DeviceStage::Device stage_device(std::shared_ptr<Lidar> lidar);
DeviceStage::Device stage_device(std::shared_ptr<TriggerLine> line);

}  // namespace sparsight
