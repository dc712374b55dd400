#pragma once

#include <chrono>

#include "hal/time.h"

namespace sparsight {

// CLOCK_REALTIME and CLOCK_MONOTONIC at one instant.
struct ClockPair {
  std::chrono::nanoseconds realtime{0};  // since 1970
  HostTime monotonic;
};

// Both clocks, read so close together that they are one instant to some hundred nanoseconds.
ClockPair read_clocks();

// Brings stamps of CLOCK_REALTIME, which is what the kernel gives to datagrams, onto
// CLOCK_MONOTONIC. CLOCK_REALTIME may be set at any moment, also between a stamp and its being
// read; then the stamp is of the time before. Thread-bound; real-time-safe.
class RealtimeBridge {
 public:
  // To be called after stamps have been read and before they are mapped.
  void update(const ClockPair& now);
  // Never later than the last update, as a stamp cannot be of the future.
  HostTime to_host(std::chrono::nanoseconds realtime) const;

 private:
  bool updated_ = false;
  HostTime now_;
  HostTime before_;                     // at the update before
  std::chrono::nanoseconds offset_{0};  // monotonic minus realtime
  std::chrono::nanoseconds offset_before_{0};
};

}  // namespace sparsight
