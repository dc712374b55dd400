#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hal/lidar.h"

namespace sparsight {

// The returns of one turn of the head, in the order of firing.
struct Revolution {
  enum class End : std::uint8_t {
    kSeam,       // the head came round
    kTime,       // it did not in time: it stands, or packets are missing
    kClockJump,  // the sensor's clock was set: what follows cannot be compared
    kFlush,      // there was no more
  };
  std::vector<TimedReturn> returns;
  SensorTime begin;  // when the head passed the seam; of a partial revolution, its first firing
  SensorTime end;    // likewise; of a partial one, the end of its last packet
  std::uint32_t epoch = 0;
  HostTime arrival;    // of the last packet that belongs to it
  bool whole = false;  // from seam to seam, though maybe with packets missing
  End ended_by = End::kFlush;
  // Firings of a laser, with or without return. Expected: as many as fit between begin and end.
  std::uint64_t expected_firings = 0;
  std::uint64_t received_firings = 0;
};

struct SweepAssemblerConfig {
  double seam_azimuth_deg = 180.0;
  // Longer than a turn at the lowest speed (200 ms at 300 rpm).
  std::chrono::nanoseconds max_duration = std::chrono::milliseconds(250);
};

// Cuts the stream of returns into revolutions, each return on its own side of the seam: packets
// know nothing of it. Thread-bound.
class SweepAssembler {
 public:
  explicit SweepAssembler(const SweepAssemblerConfig& config = {});

  void add(const DecodedPacket& packet);
  // The revolutions that are finished, the oldest first.
  std::optional<Revolution> take();
  // Finishes what has been gathered so far.
  void flush();

 private:
  // What is remembered of the packet before. Angles are counted on over the turns.
  struct Position {
    double azimuth_deg = 0.0;
    SensorTime time;
    double rate_deg_per_ns = 0.0;
  };

  double unwrapped(const DecodedPacket& packet) const;
  void begin_at_packet(const DecodedPacket& packet);
  void pass_seam_between_packets(double azimuth_deg, SensorTime time);
  void add_firings(const DecodedPacket& packet, double azimuth_deg);
  void pass_seam(SensorTime when);
  void finish(Revolution::End end, SensorTime when);

  SweepAssemblerConfig config_;
  bool gathering_ = false;
  bool from_seam_ = false;  // the current revolution began at the seam
  Position before_;
  SensorTime packet_end_;
  double next_seam_deg_ = 0.0;
  Revolution current_;
  std::deque<Revolution> finished_;
};

}  // namespace sparsight
