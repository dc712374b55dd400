#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/gpio/libgpiod_calls.h"
#include "drivers/gpio/watched_line.h"
#include "hal/rig_config.h"
#include "hal/trigger_line.h"

namespace sparsight {

// The exposure line, and the PPS line where one is wired, as GPIO lines whose edges the kernel
// stamps in its interrupt handler. To be read by a thread of real-time priority: the kernel holds
// 16 edges of a line, a quarter of a second at 30 Hz.
class GpioTriggerLine final : public TriggerLine {
 public:
  explicit GpioTriggerLine(TriggerConfig config, GpioCalls& calls = libgpiod_calls());

  Result<void> start() override;
  std::optional<Edge> read(std::chrono::nanoseconds patience) override;
  void stop() override;
  DeviceState state() const override { return state_; }
  TriggerCounters counters() const override { return counters_; }

  // Why the lines were lost or an edge was left out; "" if neither happened.
  const std::string& last_fault() const { return last_fault_; }

 private:
  Result<void> watch_lines();
  Result<void> watch(EdgeLine line, unsigned offset, WatchedEdges edges, bool active_low);
  void advance(std::chrono::nanoseconds patience);
  void look_for_lines(std::chrono::nanoseconds patience);
  bool drain_all();
  void lose_lines(int negative_errno);
  std::optional<Edge> first_edge();
  WatchedLine* line_with_first_edge() const;
  std::chrono::nanoseconds unsettled() const;

  TriggerConfig config_;
  GpioCalls& calls_;
  std::vector<std::unique_ptr<WatchedLine>> lines_;
  std::vector<int> handles_;
  DeviceState state_ = DeviceState::kStopped;
  TriggerCounters counters_;
  std::string last_fault_;
  HostTime last_edge_;  // given out
  HostTime last_sign_of_life_;
  HostTime next_attempt_;
};

}  // namespace sparsight
