#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "hal/time.h"

namespace sparsight {

enum class WatchedEdges : std::uint8_t { kRising, kBoth };

// A level change as the kernel stamped it; rising in terms of the signal, whatever its polarity.
struct LineEvent {
  bool rising = true;
  HostTime time;
};

// The kernel keeps so many events of a line and then drops the newest without a word
// (linux/gpio.h, first version of the interface, which libgpiod 1 speaks).
inline constexpr std::size_t kKernelQueue = 16;

// The part of libgpiod that a trigger line needs, so that tests can take its place. Failures are
// negative errno values.
class GpioCalls {
 public:
  virtual ~GpioCalls() = default;
  // A handle of the line, to be released.
  virtual int watch(const std::string& chip, unsigned line, WatchedEdges edges,
                    bool active_low) = 0;
  virtual void release(int handle) = 0;
  // Above 0 as soon as one of the lines has events or has failed; 0 if none within `patience`.
  virtual int wait(std::span<const int> handles, std::chrono::nanoseconds patience) = 0;
  // What the kernel holds, oldest first; 0 if it holds none.
  virtual int read(int handle, std::span<LineEvent, kKernelQueue> events) = 0;
  virtual void sleep(std::chrono::nanoseconds duration) = 0;
  virtual HostTime now() = 0;
};

}  // namespace sparsight
