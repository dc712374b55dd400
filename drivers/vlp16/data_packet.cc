#include "drivers/vlp16/data_packet.h"

#include <algorithm>
#include <optional>

#include "drivers/vlp16/wire_format.h"

namespace sparsight {
namespace {

// Between two blocks the head turns 0.8 degrees at 1200 rpm, the most it can. A wider gap is the
// dead arc of a narrowed field of view, and says nothing of the rate.
constexpr int kMaxBlockGapCentideg = 120;
constexpr double kDegreesPerCentideg = 0.01;
constexpr double kFiringsPerBlockGap =
    static_cast<double>((kVlp16SequencesPerBlock * kVlp16SequenceInterval).count()) /
    static_cast<double>(kVlp16FiringInterval.count());
constexpr double kFiringsPerSequence = kFiringsPerBlockGap / kVlp16SequencesPerBlock;

std::optional<ReturnMode> return_mode(std::uint8_t byte) {
  switch (byte) {
    case wire::kStrongest:
      return ReturnMode::kStrongest;
    case wire::kLast:
      return ReturnMode::kLast;
    case wire::kDual:
      return ReturnMode::kDual;
    default:
      return std::nullopt;
  }
}

std::optional<LidarModel> model_of(std::uint8_t product) {
  if (product == wire::kVlp16) return LidarModel::kVlp16;
  if (product == wire::kVlp16HiRes) return LidarModel::kVlp16HiRes;
  return std::nullopt;
}

std::optional<PacketFault> fault_of(const wire::DataPacket& packet) {
  if (!model_of(packet.product)) return PacketFault::kProduct;
  if (!return_mode(packet.return_mode)) return PacketFault::kReturnMode;
  for (const wire::Block& block : packet.blocks) {
    if (block.flag != wire::kBlockFlag) return PacketFault::kBlockFlag;
    if (block.azimuth_centideg >= wire::kFullTurnCentideg) return PacketFault::kAzimuth;
  }
  if (packet.return_mode != wire::kDual) return std::nullopt;
  for (std::size_t b = 0; b < packet.blocks.size(); b += 2) {
    if (packet.blocks[b].azimuth_centideg != packet.blocks[b + 1].azimuth_centideg) {
      return PacketFault::kPair;
    }
  }
  return std::nullopt;
}

// The way from one azimuth to the next, across zero if need be: [-18000, 18000).
int step_centideg(int from, int to) {
  constexpr int kTurn = wire::kFullTurnCentideg;
  return (to - from + kTurn + kTurn / 2) % kTurn - kTurn / 2;
}

// How far the head turns from each block (or dual pair) to the one after it.
class BlockGaps {
 public:
  BlockGaps(const wire::DataPacket& packet, std::size_t stride) {
    int sum = 0;
    int count = 0;
    for (std::size_t b = 0; b + stride < packet.blocks.size(); b += stride) {
      const int gap = step_centideg(packet.blocks[b].azimuth_centideg,
                                    packet.blocks[b + stride].azimuth_centideg);
      gaps_[b] = gap;
      // A dead arc may be wider than half a turn.
      turned_ += gap < -kMaxBlockGapCentideg ? gap + wire::kFullTurnCentideg : gap;
      if (std::abs(gap) > kMaxBlockGapCentideg) continue;
      sum += gap;
      ++count;
    }
    // The blocks' azimuths are rounded: over the whole packet the rate is known ten times better
    // than from the last gap.
    mean_ = count > 0 ? static_cast<double>(sum) / count : 0.0;
    turned_ += mean_;
  }
  // Manual p. 66 says how, and is misprinted in three ways: the rate is the gap over the *two*
  // sequences that lie between blocks. After the last block the packet's own rate goes on.
  double after(std::size_t block) const {
    const std::optional<int> gap = gaps_[block];
    return gap && std::abs(*gap) <= kMaxBlockGapCentideg ? *gap : mean_;
  }
  double turned() const { return turned_; }

 private:
  std::array<std::optional<int>, kVlp16BlocksPerPacket> gaps_;
  double mean_ = 0.0;
  double turned_ = 0.0;
};

Echo echo_of(const wire::Measurement& measurement) {
  return {measurement.distance_2mm, measurement.reflectivity};
}

// Both blocks of a dual pair name a lone return: it is told once.
Echo second_echo(const wire::Measurement& last, const wire::Measurement& strongest) {
  return last.distance_2mm == strongest.distance_2mm ? Echo{} : echo_of(strongest);
}

double wrapped(double azimuth_deg) {
  if (azimuth_deg >= 360.0) return azimuth_deg - 360.0;
  return azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg;
}

void read_block(const wire::DataPacket& packet, std::size_t b, double gap_centideg,
                std::size_t first_sequence, DataPacket& out) {
  const bool dual = out.mode == ReturnMode::kDual;
  const wire::Block& block = packet.blocks[b];
  const wire::Block& pair = packet.blocks[dual ? b + 1 : b];
  const double turn_per_firing = gap_centideg * kDegreesPerCentideg / kFiringsPerBlockGap;
  for (std::size_t s = 0; s < kVlp16SequencesPerBlock; ++s) {
    SequenceReading& sequence = out.sequences[first_sequence + s];
    sequence.azimuth_deg = wrapped(block.azimuth_centideg * kDegreesPerCentideg +
                                   static_cast<double>(s) * kFiringsPerSequence * turn_per_firing);
    sequence.turn_per_firing_deg = turn_per_firing;
    for (std::size_t k = 0; k < kVlp16Lasers; ++k) {
      const std::size_t channel = s * kVlp16Lasers + k;
      sequence.echoes[k] = echo_of(block.measurements[channel]);
      sequence.second_echoes[k] =
          dual ? second_echo(block.measurements[channel], pair.measurements[channel]) : Echo{};
    }
  }
}

}  // namespace

const char* to_string(PacketFault fault) {
  switch (fault) {
    case PacketFault::kProduct:
      return "not a VLP-16 (product byte is neither 0x22 nor 0x24)";
    case PacketFault::kReturnMode:
      return "unknown return mode (byte 1204 is not 0x37, 0x38 or 0x39)";
    case PacketFault::kBlockFlag:
      return "a block does not begin with FF EE";
    case PacketFault::kAzimuth:
      return "an azimuth is beyond 359.99 degrees";
    case PacketFault::kPair:
      return "the blocks of a dual-return pair have different azimuths";
  }
  return "unknown fault";
}

tl::expected<void, PacketFault> read_data_packet(const std::array<std::uint8_t, 1206>& payload,
                                                 DataPacket& packet) {
  const auto wire_packet = wire::from_bytes<wire::DataPacket>(payload);
  if (const auto fault = fault_of(wire_packet)) return tl::make_unexpected(*fault);
  packet.microseconds_past_hour = wire_packet.microseconds_past_hour;
  packet.mode = *return_mode(wire_packet.return_mode);
  packet.model = *model_of(wire_packet.product);
  const std::size_t stride = packet.mode == ReturnMode::kDual ? 2 : 1;
  const BlockGaps gaps(wire_packet, stride);
  packet.sequence_count = kVlp16SequencesPerPacket / stride;
  packet.turned_deg = gaps.turned() * kDegreesPerCentideg;
  for (std::size_t b = 0; b < kVlp16BlocksPerPacket; b += stride) {
    read_block(wire_packet, b, gaps.after(b), b / stride * kVlp16SequencesPerBlock, packet);
  }
  return {};
}

}  // namespace sparsight
