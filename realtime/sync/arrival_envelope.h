#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/time.h"
#include "realtime/sync/clock_line.h"

namespace sparsight {

// A message may come late but never early, so the line from device time to arrival lies below all
// pairs, and touches those that were not delayed. The lower convex hull of the pairs (Zhang, Liu,
// Xia 2002, "Clock synchronization algorithms for network measurements") gives the line that is
// nearest to all of them from below: the hull's edge under their mean. Bounded memory.
class ArrivalEnvelope {
 public:
  void add(SensorTime device, HostTime arrival);  // device times that do not grow are left out
  void clear();

  std::optional<ClockLine> line() const;
  std::chrono::nanoseconds span() const;
  std::size_t count() const { return count_; }

 private:
  struct Point {
    double device_ns;  // since the first
    double offset_ns;  // arrival minus device, less that of the first
  };

  static bool turns_right(const Point& a, const Point& b, const Point& c);
  void thin();

  SensorTime first_device_;
  HostTime first_arrival_;
  std::size_t count_ = 0;
  double sum_device_ns_ = 0.0;
  std::vector<Point> hull_;
};

struct SlidingEnvelopeConfig {
  std::chrono::nanoseconds window{40'000'000'000};
  // Arrivals that leave the line by more than this, all of them for two blocks or several on its
  // impossible side, mean that the clock has been set: all begins anew.
  std::chrono::nanoseconds step{400'000};
  std::chrono::nanoseconds block{1'000'000'000};
};

// The envelope of the last window/2 to window: two of them, half a window apart; the older one is
// used and then gives way to the younger (as cuckoo_time_translator switches its estimators).
class SlidingEnvelope {
 public:
  explicit SlidingEnvelope(const SlidingEnvelopeConfig& config = {}) : config_(config) {}

  void add(SensorTime device, HostTime arrival);
  void clear();

  std::optional<ClockLine> line() const { return line_; }
  // One sigma of the line, apart from the least delay, which nobody knows.
  std::chrono::nanoseconds uncertainty() const;
  std::chrono::nanoseconds mean_delay() const;  // beyond the least
  std::uint32_t restarts() const { return restarts_; }

 private:
  static constexpr double kExpectedDelayNs = 1e6;  // before any is known

  bool stepped(double residual_ns, SensorTime device);
  void restart();

  SlidingEnvelopeConfig config_;
  ArrivalEnvelope current_;
  ArrivalEnvelope next_;
  std::optional<ClockLine> line_;
  double mean_residual_ns_ = kExpectedDelayNs;
  int early_ = 0;
  SensorTime block_start_;
  double least_in_block_ns_ = 0.0;
  bool block_empty_ = true;
  int lifted_blocks_ = 0;
  std::uint32_t restarts_ = 0;
};

}  // namespace sparsight
