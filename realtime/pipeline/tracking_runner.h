#pragma once

#include <chrono>
#include <optional>

#include "realtime/executor/fixed_rate_loop.h"
#include "realtime/executor/loop_clock.h"
#include "realtime/executor/phase_lock.h"
#include "realtime/pipeline/live_shared.h"
#include "realtime/pipeline/search_deadline.h"
#include "realtime/pipeline/stage_thread.h"
#include "slam/tracking_stage.h"

namespace sparsight {

// The fixed-rate thread: wakes just after a frame is due, tracks it, says where the camera is, and
// hands keyframes on. After its first tick it allocates nothing, takes no lock, touches no file and
// logs nothing; it waits for nothing but the time. Thread-bound.
class TrackingRunner {
 public:
  TrackingRunner(TrackingStage& tracking, std::chrono::nanoseconds period, LiveShared& shared,
                 LoopClock& clock);

  // Until the thread is told to stop and no frame is left.
  void run(StageThread& thread);
  // One round: waits for its time, tracks what is there. False if no frame came.
  bool tick();

 private:
  bool track_waiting(HostTime due);
  void track(LiveFrame& frame, HostTime deadline);
  void journal(const LiveFrame& frame, HostTime begun, HostTime done);

  TrackingStage& tracking_;
  LiveShared& shared_;
  LoopClock& clock_;
  FixedRateLoop loop_;
  PhaseLock phase_;
  SearchDeadline search_;
  HostTime last_ready_;
};

}  // namespace sparsight
