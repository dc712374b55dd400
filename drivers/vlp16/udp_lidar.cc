#include "drivers/vlp16/udp_lidar.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include "drivers/vlp16/lidar_payload.h"
#include "drivers/vlp16/network_interface.h"

namespace sparsight {
namespace {

std::timespec timespec_of(std::chrono::nanoseconds duration) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
  std::timespec time{};
  time.tv_sec = seconds.count();
  time.tv_nsec = (duration - seconds).count();
  return time;
}

}  // namespace

UdpLidar::UdpLidar(const LidarConfig& config, const UdpLidarOptions& options)
    : config_(config), options_(options) {
  pending_.reserve(2 * UdpReceiver::kBatch);
}

Result<void> UdpLidar::start() {
  if (state_ != DeviceState::kStopped) return {};
  if (auto opened = open(); !opened) {
    stop();
    return opened;
  }
  counters_ = {};
  bridge_ = {};
  last_packet_.reset();
  state_ = DeviceState::kSilent;
  return {};
}

Result<void> UdpLidar::open() {
  sensor_.reset();
  if (!config_.sensor_address.empty()) {
    const auto sensor = ipv4_address(config_.sensor_address);
    if (!sensor) {
      return fail(sensor.error().code, "lidar.sensor_address: " + sensor.error().message);
    }
    sensor_ = *sensor;
  }
  auto data =
      UdpReceiver::open(config_.bind_address, config_.data_port, options_.receive_buffer_bytes);
  if (!data) return tl::make_unexpected(std::move(data.error()));
  auto positions =
      UdpReceiver::open(config_.bind_address, config_.position_port, options_.receive_buffer_bytes);
  if (!positions) return tl::make_unexpected(std::move(positions.error()));
  data_.emplace(std::move(*data));
  positions_.emplace(std::move(*positions));
  return {};
}

void UdpLidar::stop() {
  data_.reset();
  positions_.reset();
  pending_.clear();
  next_pending_ = 0;
  state_ = DeviceState::kStopped;
}

std::filesystem::path UdpLidar::system_folder() const {
  const auto interface = sensor_ ? interface_towards(*sensor_) : std::nullopt;
  if (!interface) return {};
  return std::filesystem::path("/sys/class/net") / *interface;
}

std::optional<LidarMessage> UdpLidar::read(std::chrono::nanoseconds patience) {
  if (state_ == DeviceState::kStopped) return std::nullopt;
  HostTime now = read_clocks().monotonic;
  const HostTime deadline = now + patience;
  if (next_pending_ == pending_.size()) receive();
  while (next_pending_ == pending_.size() && now < deadline) {
    // What came may have been refused: then the rest of the time is still to be waited.
    if (wait(deadline - now)) receive();
    now = read_clocks().monotonic;
  }
  auto message = pop();
  // Position packets alone do not make a scan.
  if (message && std::holds_alternative<LidarPacket>(*message)) last_packet_ = now;
  const bool data_come = last_packet_ && now - *last_packet_ <= options_.silent_after;
  state_ = data_come ? DeviceState::kStreaming : DeviceState::kSilent;
  return message;
}

bool UdpLidar::wait(std::chrono::nanoseconds patience) const {
  std::array<pollfd, 2> sockets{pollfd{data_->descriptor(), POLLIN, 0},
                                pollfd{positions_->descriptor(), POLLIN, 0}};
  const std::timespec timeout = timespec_of(patience);
  // Interrupted by a signal counts as nothing; the caller looks at the time again.
  return ppoll(sockets.data(), sockets.size(), &timeout, nullptr) > 0;
}

void UdpLidar::receive() {
  pending_.clear();
  next_pending_ = 0;
  // Position packets first: a data packet that comes meanwhile is then later than all of them.
  auto positions = positions_->receive();
  auto data = data_->receive();
  if (positions.empty() && data.empty()) return;
  bridge_.update(read_clocks());
  counters_.dropped = data_->dropped() + positions_->dropped();
  while (!data.empty() || !positions.empty()) {
    // Each port's own order is kept, whatever its stamps say.
    if (data.empty() || (!positions.empty() && positions.front().stamp < data.front().stamp)) {
      take<PositionPacket>(positions.front(), counters_.positions);
      positions = positions.subspan(1);
    } else {
      take<LidarPacket>(data.front(), counters_.packets);
      data = data.subspan(1);
    }
  }
  put_arrivals_in_order();
}

// What the kernel did not stamp in time it stamps when it is read, after what came later: a
// datagram cannot have come after the one behind it in the same queue.
void UdpLidar::put_arrivals_in_order() {
  std::array<HostTime, std::variant_size_v<LidarMessage>> next;
  next.fill(HostTime::max());
  for (auto message = pending_.rbegin(); message != pending_.rend(); ++message) {
    HostTime& of_kind = next[message->index()];
    std::visit([&](auto& packet) { of_kind = packet.arrival = std::min(packet.arrival, of_kind); },
               *message);
  }
}

template <typename Packet>
void UdpLidar::take(const ReceivedDatagram& datagram, std::uint64_t& count) {
  const bool from_sensor = !sensor_ || datagram.source == *sensor_;
  auto message = from_sensor && datagram.size == datagram.payload.size()
                     ? lidar_message<Packet>(datagram.payload, bridge_.to_host(datagram.stamp))
                     : std::nullopt;
  if (!message) {
    ++counters_.refused;
    return;
  }
  pending_.push_back(std::move(*message));
  ++count;
}

std::optional<LidarMessage> UdpLidar::pop() {
  if (next_pending_ == pending_.size()) return std::nullopt;
  return pending_[next_pending_++];
}

}  // namespace sparsight
