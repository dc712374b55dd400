#pragma once

#include <filesystem>
#include <optional>

#include "drivers/vlp16/pcap_reader.h"
#include "hal/lidar.h"
#include "hal/rig_config.h"

namespace sparsight {

// The LiDAR of a capture: its packets as fast as they are asked for, `arrival` being when they were
// captured, on the capture's own time line. The first sender on the configured ports is the sensor,
// whatever its address: a person chose this file. Starting again begins at the beginning.
// Thread-bound.
class PcapLidar final : public Lidar {
 public:
  explicit PcapLidar(std::filesystem::path file, const LidarConfig& config = {});

  Result<void> start() override;
  std::optional<LidarMessage> read(std::chrono::nanoseconds patience) override;
  void stop() override;
  DeviceState state() const override { return state_; }
  LidarCounters counters() const override;

  // What is wrong with the file where it could not be read on; empty if it ended well.
  std::string damage() const { return reader_ ? reader_->damage() : std::string(); }

 private:
  std::optional<LidarMessage> message_of(const CapturedDatagram& captured);

  std::filesystem::path file_;
  std::uint16_t data_port_;
  std::uint16_t position_port_;
  std::optional<PcapReader> reader_;
  std::optional<std::uint32_t> sensor_;
  DeviceState state_ = DeviceState::kStopped;
  LidarCounters counters_;
};

}  // namespace sparsight
