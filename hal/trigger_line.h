#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/device.h"
#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

enum class EdgeLine : std::uint8_t { kExposure, kPps };

// A level change on a GPIO line, stamped by the kernel on CLOCK_MONOTONIC.
struct Edge {
  EdgeLine line = EdgeLine::kExposure;
  bool rising = true;  // in terms of the signal: the start of the exposure, of the pulse
  HostTime time;
};

struct TriggerCounters {
  std::uint64_t edges = 0;
  std::uint64_t repeated = 0;    // two of one direction in a row: one between them was lost
  std::uint64_t full_reads = 0;  // a read that emptied a full kernel queue: more may have been lost
};

// The lines that mark exposures and, where it is wired, the second. Thread-bound.
class TriggerLine {
 public:
  virtual ~TriggerLine() = default;
  virtual Result<void> start() = 0;
  // The next edge in the order of their times; nothing if none comes within `patience`.
  virtual std::optional<Edge> read(std::chrono::nanoseconds patience) = 0;
  virtual void stop() = 0;
  virtual DeviceState state() const = 0;
  virtual TriggerCounters counters() const = 0;
};

}  // namespace sparsight
