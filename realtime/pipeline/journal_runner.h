#pragma once

#include <array>
#include <deque>
#include <optional>

#include "hal/rig_event.h"
#include "realtime/executor/loop_clock.h"
#include "realtime/executor/spsc_queue.h"
#include "realtime/pipeline/anchored_trajectory.h"
#include "realtime/pipeline/live_outputs.h"
#include "realtime/pipeline/live_shared.h"
#include "realtime/pipeline/stage_thread.h"

namespace sparsight {

// Writes down what happens: raw events to the recording, a row of the journal for each frame. It is
// never asked to leave any of that out; only previews it leaves out when it is behind.
class JournalRunner {
 public:
  static constexpr std::size_t kDevices = 3;

  JournalRunner(std::array<SpscQueue<RigEvent>*, kDevices> devices, const LiveOutputs& outputs,
                LiveShared& shared, LoopClock& clock)
      : devices_(devices), outputs_(outputs), shared_(shared), clock_(clock) {}

  // Until the thread is told to stop and nothing is left.
  void run(StageThread& thread);
  // Once it has ended.
  const AnchoredTrajectory& trajectory() const { return trajectory_; }

 private:
  void record_events();
  void take_records();
  void preview(const LiveRecord& record);
  void write_rows(bool all);
  void write_row(const LiveRecord& row, std::chrono::nanoseconds window_time);
  std::vector<Error> faults_of(std::uint64_t sequence);

  std::array<SpscQueue<RigEvent>*, kDevices> devices_;
  const LiveOutputs& outputs_;
  LiveShared& shared_;
  LoopClock& clock_;
  AnchoredTrajectory trajectory_;
  std::deque<LiveRecord> rows_;  // keyframes wait for their window's time, others behind them
  std::deque<WindowReport> reports_;
};

}  // namespace sparsight
