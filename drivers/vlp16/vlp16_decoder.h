#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include "drivers/vlp16/data_packet.h"
#include "drivers/vlp16/sensor_clock.h"
#include "hal/lidar.h"
#include "hal/rig_config.h"

namespace sparsight {

// VLP-16, Puck LITE and Puck Hi-Res, told apart by the packets themselves. Thread-bound;
// real-time-safe once `out` has grown to a packet's size.
class Vlp16Decoder final : public LidarDecoder {
 public:
  explicit Vlp16Decoder(const LidarConfig& config = {});

  bool decode(const LidarPacket& packet, DecodedPacket& out) override;
  std::optional<LidarClockReport> decode(const PositionPacket& packet) override;
  DecoderCounters counters() const override { return counters_; }

  // Why the last data packet that was refused was refused; nothing if none was.
  std::optional<PacketFault> last_fault() const { return last_fault_; }

 private:
  struct Beam {
    double level = 1.0;  // cosine and sine of its elevation
    double upward = 0.0;
    double offset_m = 0.0;
    std::uint16_t ring = 0;
  };
  using Beams = std::array<Beam, kVlp16Lasers>;

  static Beams beams_of(const LaserTable& nominal, const LidarConfig& config);
  bool take_stamp(HostTime arrival, DecodedPacket& out);
  void add_returns(DecodedPacket& out) const;
  void add_sequence(const SequenceReading& sequence, const Beams& beams, SensorTime fired,
                    std::vector<TimedReturn>& returns) const;

  Beams vlp16_;
  Beams hi_res_;
  std::uint16_t min_distance_2mm_;
  std::uint16_t max_distance_2mm_;
  SensorTimeline timeline_;
  std::chrono::nanoseconds last_interval_{0};  // of the packet before; 0 before the first
  DataPacket packet_;
  DecoderCounters counters_;
  std::optional<PacketFault> last_fault_;
};

}  // namespace sparsight
