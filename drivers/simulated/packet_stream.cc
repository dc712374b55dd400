#include "drivers/simulated/packet_stream.h"

#include <algorithm>
#include <utility>

namespace sparsight::simulated {
namespace {

constexpr std::uint64_t kPacketsPerBundle = 28;
// Manual, p. 60: after 14 packets, of single returns.
std::uint64_t packets_per_position(const SimulationOptions& options) {
  return options.return_mode == ReturnMode::kDual ? 28 : 14;
}

}  // namespace

PacketStream::PacketStream(const LidarScanner& scanner, const LidarClock& clock,
                           const FaultPlan& faults, const SimulationOptions& options)
    : scanner_(scanner),
      clock_(clock),
      faults_(faults),
      options_(options),
      last_arrival_(options.start),
      bundles_ahead_([this](std::uint64_t bundle) { return make(bundle); }, 2) {
  while (clock_.packet_start(packets_ + 1) <= options.duration) ++packets_;
  bundles_ = (packets_ + kPacketsPerBundle - 1) / kPacketsPerBundle;
  refill();
}

std::vector<LidarMessage> PacketStream::make(std::uint64_t bundle) const {
  std::vector<LidarMessage> messages;
  const std::uint64_t per_position = packets_per_position(options_);
  const std::uint64_t end = std::min(packets_, (bundle + 1) * kPacketsPerBundle);
  for (std::uint64_t number = bundle * kPacketsPerBundle; number < end; ++number) {
    if (faults_.away(DeviceKind::kLidar, clock_.packet_start(number))) continue;
    if (!faults_.loses_packet(number)) messages.emplace_back(scanner_.packet(number));
    if (number % per_position == per_position / 2) {
      messages.emplace_back(scanner_.position(number));
    }
  }
  return messages;
}

void PacketStream::refill() {
  while (ready_.empty() && next_bundle_ < bundles_) {
    for (LidarMessage& message : bundles_ahead_.take(next_bundle_, bundles_)) {
      std::visit(
          [this](auto& packet) {
            // One wire, one queue: what was late delays what follows.
            packet.arrival = std::max(options_.start + packet.arrival.time_since_epoch(),
                                      last_arrival_ + std::chrono::microseconds(5));
            last_arrival_ = packet.arrival;
            ready_.emplace_back(std::move(packet));
          },
          message);
    }
    ++next_bundle_;
  }
}

std::optional<HostTime> PacketStream::peek() const {
  if (ready_.empty()) return std::nullopt;
  return arrival_of(ready_.front());
}

RigEvent PacketStream::take() {
  RigEvent event = std::move(ready_.front());
  ready_.pop_front();
  refill();
  return event;
}

}  // namespace sparsight::simulated
