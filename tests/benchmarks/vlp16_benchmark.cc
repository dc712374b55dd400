#include <benchmark/benchmark.h>

#include <cstring>
#include <random>

#include "drivers/vlp16/packet_writer.h"
#include "drivers/vlp16/sweep_assembler.h"
#include "drivers/vlp16/vlp16_decoder.h"

namespace sparsight {
namespace {

constexpr std::size_t kPacketsPerTurn = 75;

// A turn at 603 rpm among walls 3 to 30 m away, every firing with a return: the most there can be.
std::vector<LidarPacket> packets_of_a_turn(ReturnMode mode) {
  std::mt19937 random(1);
  const bool dual = mode == ReturnMode::kDual;
  std::vector<LidarPacket> packets((dual ? 2 : 1) * kPacketsPerTurn);
  std::array<FiringSequence, kVlp16SequencesPerPacket> sequences;
  std::size_t block = 0;
  for (std::size_t p = 0; p < packets.size(); ++p) {
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      const std::size_t turned = dual ? block + s / 4 : block + s / 2;
      sequences[s].azimuth_centideg = static_cast<std::uint16_t>(40 * turned % 36000);
      for (auto& distance : sequences[s].distance_2mm) {
        distance = static_cast<std::uint16_t>(1500 + random() % 13500);
      }
    }
    block += dual ? 6 : 12;
    packets[p].payload = write_data_packet(sequences, 0, mode);
  }
  return packets;
}

// As the packets come by, turn after turn.
void set_time(LidarPacket& packet, std::chrono::nanoseconds time) {
  packet.arrival = HostTime(std::chrono::seconds(1) + time);
  const auto microseconds = static_cast<std::uint32_t>(time / std::chrono::microseconds(1));
  const std::uint32_t stamp = microseconds % 3'600'000'000U;
  std::memcpy(packet.payload.data() + 1200, &stamp, sizeof(stamp));
}

void decode_a_revolution(benchmark::State& state, ReturnMode mode, bool assemble) {
  std::vector<LidarPacket> packets = packets_of_a_turn(mode);
  const auto interval = mode == ReturnMode::kDual ? kVlp16DualPacketInterval : kVlp16PacketInterval;
  Vlp16Decoder decoder;
  SweepAssembler assembler;
  DecodedPacket decoded;
  std::chrono::nanoseconds time{0};
  std::size_t returns = 0;
  for (auto _ : state) {
    returns = 0;
    for (LidarPacket& packet : packets) {
      set_time(packet, time);
      time += interval;
      decoder.decode(packet, decoded);
      returns += decoded.returns.size();
      benchmark::DoNotOptimize(decoded.returns.data());
      if (assemble) assembler.add(decoded);
    }
    while (assemble && assembler.take()) continue;
  }
  state.counters["returns"] = static_cast<double>(returns);
  state.counters["refused"] = static_cast<double>(decoder.counters().refused);
}
BENCHMARK_CAPTURE(decode_a_revolution, strongest, ReturnMode::kStrongest, false);
BENCHMARK_CAPTURE(decode_a_revolution, dual, ReturnMode::kDual, false);
BENCHMARK_CAPTURE(decode_a_revolution, strongest_into_revolutions, ReturnMode::kStrongest, true);

}  // namespace
}  // namespace sparsight
