#pragma once

#include <cstdint>

#include "drivers/simulated/fault_plan.h"
#include "drivers/simulated/simulation_options.h"

namespace sparsight::simulated {

// A frame's life: exposed, read out, taken from the driver.
struct FrameTimes {
  Elapsed exposed;  // beginning
  Elapsed middle;
  Elapsed driver;  // when the driver stamps it
  Elapsed arrival;
};

// When the camera is exposed.
class CameraClock {
 public:
  explicit CameraClock(const SimulationOptions& options);
  FrameTimes frame(std::uint64_t number) const;

 private:
  SimulationOptions options_;
  double period_s_;
  double phase_s_;
};

// The second's pulse, and when a line's change is stamped after it happened.
class PulseClock {
 public:
  explicit PulseClock(std::uint64_t seed);
  Elapsed pulse(std::int64_t number) const;
  std::int64_t last_before(Elapsed at) const;  // -1 before the first
  // UTC of a pulse, seconds since midnight.
  std::int64_t second_of_day(std::int64_t number) const { return first_second_ + number; }

 private:
  Elapsed phase_;
  std::int64_t first_second_;
};

// Latency of an interrupt: a few microseconds, now and then some ten.
Elapsed edge_latency(std::uint64_t seed, std::uint64_t number);

// From packet to packet by the LiDAR's clock: a dual one is full in half the time.
Elapsed packet_interval(const SimulationOptions& options);

// What the LiDAR's own clock shows, and when its lasers fire by it.
class LidarClock {
 public:
  LidarClock(const SimulationOptions& options, const FaultPlan& faults, const PulseClock& pulses);

  Elapsed packet_start(std::uint64_t packet) const;
  Elapsed firing(std::uint64_t packet, std::int64_t offset_ns) const;
  // Of the head; degrees, clockwise from ahead, unwrapped.
  double azimuth_deg(Elapsed at) const;
  std::uint32_t microseconds_past_hour(Elapsed at) const;

 private:
  SimulationOptions options_;
  const FaultPlan& faults_;
  const PulseClock& pulses_;
  double rate_;  // of its oscillator, about 1
  Elapsed phase_;
  double first_azimuth_deg_;
  double turns_per_s_;
  double free_start_s_;
};

}  // namespace sparsight::simulated
