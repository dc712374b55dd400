#pragma once

#include "realtime/executor/loop_clock.h"
#include "realtime/pipeline/live_outputs.h"
#include "realtime/pipeline/live_shared.h"
#include "realtime/pipeline/stage_thread.h"

namespace sparsight {

// Takes the keyframes that leave the window to whatever is made of them: loops, graph, map. The
// thread for what may take long.
class BackgroundRunner {
 public:
  BackgroundRunner(const LiveOutputs& outputs, LiveShared& shared, LoopClock& clock)
      : outputs_(outputs), shared_(shared), clock_(clock) {}

  // Until the thread is told to stop and nothing is left.
  void run(StageThread& thread);

 private:
  void take(RetiredKeyframe&& keyframe);

  const LiveOutputs& outputs_;
  LiveShared& shared_;
  LoopClock& clock_;
};

}  // namespace sparsight
