#include "drivers/vlp16/pcap_lidar.h"

#include <utility>

#include "drivers/vlp16/lidar_payload.h"

namespace sparsight {

PcapLidar::PcapLidar(std::filesystem::path file, const LidarConfig& config)
    : file_(std::move(file)), data_port_(config.data_port), position_port_(config.position_port) {}

Result<void> PcapLidar::start() {
  if (state_ != DeviceState::kStopped) return {};
  auto reader = PcapReader::open(file_);
  if (!reader) return tl::make_unexpected(std::move(reader.error()));
  reader_.emplace(std::move(*reader));
  sensor_.reset();
  counters_ = {};
  state_ = DeviceState::kStreaming;
  return {};
}

std::optional<LidarMessage> PcapLidar::read(std::chrono::nanoseconds /*patience*/) {
  if (state_ != DeviceState::kStreaming) return std::nullopt;
  while (const auto captured = reader_->next()) {
    if (auto message = message_of(*captured)) return message;
  }
  state_ = DeviceState::kEnded;
  return std::nullopt;
}

std::optional<LidarMessage> PcapLidar::message_of(const CapturedDatagram& captured) {
  const UdpDatagram& datagram = captured.datagram;
  const bool is_data = datagram.destination_port == data_port_;
  if (!is_data && datagram.destination_port != position_port_) return std::nullopt;
  const HostTime arrival(captured.captured);
  auto message = is_data ? lidar_message<LidarPacket>(datagram.payload, arrival)
                         : lidar_message<PositionPacket>(datagram.payload, arrival);
  if (message && !sensor_) sensor_ = datagram.source;
  if (!message || datagram.source != *sensor_) {
    ++counters_.refused;
    return std::nullopt;
  }
  ++(is_data ? counters_.packets : counters_.positions);
  return message;
}

void PcapLidar::stop() { state_ = DeviceState::kStopped; }

LidarCounters PcapLidar::counters() const {
  LidarCounters counters = counters_;
  if (reader_) counters.refused += reader_->refused();
  return counters;
}

}  // namespace sparsight
