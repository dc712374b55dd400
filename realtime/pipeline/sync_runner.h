#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "hal/rig_event.h"
#include "realtime/executor/latest_value.h"
#include "realtime/executor/loop_clock.h"
#include "realtime/executor/spsc_queue.h"
#include "realtime/pipeline/live_shared.h"
#include "realtime/pipeline/stage_thread.h"
#include "realtime/sync/synchronizer.h"

namespace sparsight {

// Takes what the devices' threads deliver, in the order of arrival, through the Synchronizer, and
// puts frames on their way to tracking. Looks every millisecond: its thread may not wait on three
// queues at once, and LiDAR packets come nearly as often.
class SyncRunner {
 public:
  static constexpr std::size_t kDevices = 3;

  SyncRunner(std::array<SpscQueue<RigEvent>*, kDevices> devices,
             std::unique_ptr<Synchronizer> synchronizer, LiveShared& shared, LoopClock& clock);

  // Until the thread is told to stop and nothing is left.
  void run(StageThread& thread);
  // What the synchronisation says of itself, ten times a second; for one other thread.
  LatestValue<SyncState>& state() { return state_; }

 private:
  void drain();
  SpscQueue<RigEvent>* earliest();
  void forward();
  LiveFrame* free_frame();
  void publish(HostTime now);

  std::array<SpscQueue<RigEvent>*, kDevices> devices_;
  std::unique_ptr<Synchronizer> synchronizer_;
  LiveShared& shared_;
  LoopClock& clock_;
  LatestValue<SyncState> state_;
  HostTime last_published_;
  LiveFrame* free_ = nullptr;
  bool draining_ = false;
};

}  // namespace sparsight
