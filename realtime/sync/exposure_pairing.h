#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/time.h"
#include "hal/trigger_line.h"

namespace sparsight {

// What one exposure left on the line.
struct ExposureMark {
  HostTime start;                      // the trigger's edge where the line is a trigger
  std::chrono::nanoseconds length{0};  // zero where the line is a trigger
  bool doubtful = false;               // one of its two edges is missing, or may be a glitch
};

// Edges to exposures. Of a line that is active during the exposure a rise and a fall make one; of a
// trigger line each rise does. Thread-bound.
class ExposurePairing {
 public:
  explicit ExposurePairing(bool exposure_active) : exposure_active_(exposure_active) {}

  // The exposure that is complete with this edge, or known to remain incomplete.
  std::optional<ExposureMark> add(const Edge& edge);
  std::uint64_t incomplete() const { return incomplete_; }  // exposures of which an edge was lost

 private:
  std::optional<ExposureMark> begin(HostTime time);
  std::optional<ExposureMark> end(HostTime time);

  bool exposure_active_;
  std::optional<HostTime> rise_;
  bool rise_doubtful_ = false;
  std::uint64_t incomplete_ = 0;
  std::optional<std::chrono::nanoseconds> length_;  // of the last complete one
};

}  // namespace sparsight
