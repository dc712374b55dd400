#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/lidar.h"
#include "hal/trigger_line.h"
#include "realtime/sync/arrival_envelope.h"
#include "realtime/sync/clock_line.h"
#include "realtime/sync/pulse_train.h"

namespace sparsight {

struct LidarClockConfig {
  // From the last firing of a packet until its last bit is out: 1248 bytes at 100 Mbit/s.
  std::chrono::nanoseconds packet_delay{99'840};
  SlidingEnvelopeConfig envelope;
  // One sigma of what arrivals cannot show: the least delay of network, interrupt and kernel.
  std::chrono::nanoseconds arrival_bias{50'000};
  // A whole second by the sensor's clock may be this far from the pulse, judged by arrivals.
  std::chrono::nanoseconds most_pps_error{10'000'000};
  // One sigma of the sensor's crystal running on alone between two pulses (60 ppm, evenly spread).
  std::chrono::nanoseconds pps_sawtooth{35'000};
  std::chrono::nanoseconds report_lifetime{
      2'000'000'000};  // of the sensor's word that it is locked
  std::chrono::nanoseconds pulse_lifetime{3'000'000'000};
};

enum class LidarClockSource : std::uint8_t { kNone, kArrivals, kPps };

struct LidarClockState {
  LidarClockSource source = LidarClockSource::kNone;
  std::chrono::nanoseconds offset{0};  // host time minus sensor time
  double drift_ppm = 0.0;              // how much faster the host's clock runs
  std::chrono::nanoseconds spread{0};  // mean delay of arrivals beyond the least
  std::chrono::nanoseconds uncertainty{0};
  std::uint32_t epoch = 0;     // of the sensor's clock, as the decoder counts
  std::uint32_t restarts = 0;  // of the estimate, for any reason
  PpsState pps = PpsState::kAbsent;
  std::uint64_t pps_edges = 0;
  std::uint64_t pps_edges_lost = 0;
  std::uint64_t pps_disagreements = 0;  // packets for which pulses and arrivals did not agree
};

// The sensor's clock on the host's. Where the sensor says that it is locked to PPS and the pulses
// are seen by the host too, its whole seconds are the pulses: a line through the last of them,
// which second it is (and that it is one at all) told by the arrivals. Otherwise the lower envelope
// of the arrivals. Bounded memory; thread-bound.
class LidarClock {
 public:
  explicit LidarClock(const LidarClockConfig& config = {});

  void add(const DecodedPacket& packet);
  void add(const LidarClockReport& report);
  void add(const Edge& edge);  // of EdgeLine::kPps
  // Of the epoch of the last packet.
  const std::optional<ClockMapping>& mapping() const { return mapping_; }
  std::uint32_t epoch() const { return epoch_; }
  LidarClockState state() const;

 private:
  bool locked_at(HostTime now) const;
  std::optional<ClockMapping> by_pulses(const ClockLine& by_arrivals, HostTime now);
  void restart();

  LidarClockConfig config_;
  SlidingEnvelope envelope_;
  PulseTrain pulses_;
  std::optional<LidarClockReport> report_;
  std::optional<HostTime> last_pulse_;
  bool was_locked_ = false;
  bool begun_ = false;
  std::uint32_t epoch_ = 0;
  std::uint32_t restarts_ = 0;
  std::uint64_t disagreements_ = 0;
  std::optional<ClockMapping> mapping_;
  LidarClockSource source_ = LidarClockSource::kNone;
};

}  // namespace sparsight
