#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/vlp16/realtime_bridge.h"
#include "drivers/vlp16/udp_receiver.h"
#include "hal/lidar.h"
#include "hal/rig_config.h"

namespace sparsight {

struct UdpLidarOptions {
  int receive_buffer_bytes = 4 << 20;  // some 1500 packets, two seconds, with their overhead
  // A turn at the lowest speed takes 0.2 s, all of which may lie in the dead arc of a narrowed
  // field of view.
  std::chrono::nanoseconds silent_after = std::chrono::milliseconds(500);
};

// The LiDAR on the network. It is silent until its first packet comes, and again when they stop.
// Packets of the first milliseconds may carry the time when they were read: the kernel takes so
// long to begin stamping. read() is real-time-safe but for the waiting. Thread-bound.
class UdpLidar final : public Lidar {
 public:
  explicit UdpLidar(const LidarConfig& config, const UdpLidarOptions& options = {});

  Result<void> start() override;
  // Packets of both ports in the order of their arrival, within what the kernel holds.
  std::optional<LidarMessage> read(std::chrono::nanoseconds patience) override;
  void stop() override;
  DeviceState state() const override { return state_; }
  // Of the network interface towards the sensor; not known where packets of all senders are taken.
  std::filesystem::path system_folder() const override;
  LidarCounters counters() const override { return counters_; }

  // Where it listens while started: what was configured, or what was free.
  std::uint16_t data_port() const { return data_ ? data_->port() : 0; }
  std::uint16_t position_port() const { return positions_ ? positions_->port() : 0; }

 private:
  Result<void> open();
  void receive();
  template <typename Packet>
  void take(const ReceivedDatagram& datagram, std::uint64_t& count);
  void put_arrivals_in_order();
  bool wait(std::chrono::nanoseconds patience) const;
  std::optional<LidarMessage> pop();

  LidarConfig config_;
  UdpLidarOptions options_;
  std::optional<std::uint32_t> sensor_;  // nothing: any
  std::optional<UdpReceiver> data_;
  std::optional<UdpReceiver> positions_;
  RealtimeBridge bridge_;
  std::vector<LidarMessage> pending_;
  std::size_t next_pending_ = 0;
  std::optional<HostTime> last_packet_;  // of data
  DeviceState state_ = DeviceState::kStopped;
  LidarCounters counters_;
};

}  // namespace sparsight
