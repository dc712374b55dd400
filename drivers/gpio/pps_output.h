#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "drivers/gpio/linux_pps_port.h"
#include "drivers/gpio/pps_plan.h"
#include "hal/result.h"
#include "hal/rig_config.h"

namespace sparsight {

struct PpsOutputCounters {
  std::uint64_t pulses = 0;
  std::uint64_t sentences = 0;
  std::uint64_t late = 0;    // pulses and sentences left out, as the thread woke up too late
  std::uint64_t failed = 0;  // that the pin or the port refused
  std::chrono::nanoseconds worst_delay{0};  // of a rising edge that was given
};

// Gives the LiDAR its time: a pulse each second and the sentence that names it. A thread of
// real-time priority calls step() in a loop. The edges must be fed back to an input and believed
// there: the command's time is none. Thread-bound.
class PpsOutput {
 public:
  explicit PpsOutput(TriggerConfig config, std::unique_ptr<PpsPort> port = linux_pps_port());
  ~PpsOutput();
  PpsOutput(const PpsOutput&) = delete;
  PpsOutput& operator=(const PpsOutput&) = delete;

  Result<void> start();
  // Waits for what is due next, less than a second, and does it.
  void step();
  void stop();
  PpsOutputCounters counters() const { return counters_; }

 private:
  void perform(const PpsStep& step, std::chrono::nanoseconds delay);

  TriggerConfig config_;
  std::unique_ptr<PpsPort> port_;
  std::optional<PpsPlan> plan_;
  PpsOutputCounters counters_;
};

}  // namespace sparsight
