#pragma once

#include <deque>

#include "realtime/executor/loop_clock.h"
#include "realtime/pipeline/live_shared.h"
#include "realtime/pipeline/stage_thread.h"
#include "slam/window_stage.h"

namespace sparsight {

// Makes keyframes of what tracking hands over and optimises the window. Tracking is told twice: of
// the new keyframe as soon as it is made, and of its refined pose once the window is optimised.
class WindowRunner {
 public:
  WindowRunner(WindowStage& window, int fewer_iterations, LiveShared& shared, LoopClock& clock)
      : window_(window), fewer_iterations_(fewer_iterations), shared_(shared), clock_(clock) {}

  // Until the thread is told to stop and nothing is left; then the window is emptied.
  void run(StageThread& thread);

 private:
  void add(LiveFrame& frame);
  void publish();
  void pass_on_retired();

  WindowStage& window_;
  int fewer_iterations_;
  LiveShared& shared_;
  LoopClock& clock_;
  std::deque<RetiredKeyframe> retired_;  // for which there was no room yet: none is lost
};

}  // namespace sparsight
