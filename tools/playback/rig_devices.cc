#include "tools/playback/rig_devices.h"

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "tools/playback/packet_sender.h"
#include "tools/playback/simulated_line.h"
#include "tools/playback/video_output.h"

namespace sparsight {
namespace {

// Above everything of the program under test, as the devices are.
constexpr int kEdgePriority = 92;
constexpr int kFramePriority = 91;
constexpr int kPacketPriority = 90;

// Ten seconds.
constexpr std::size_t kFramesAhead = 300;
constexpr std::size_t kPacketsAhead = 8192;
constexpr std::size_t kEdgesAhead = 1024;

// Both lines as they are wired: by EdgeLine.
class EdgeWriter {
 public:
  static Result<std::shared_ptr<EdgeWriter>> open(const TriggerConfig& trigger) {
    auto writer = std::shared_ptr<EdgeWriter>(new EdgeWriter(trigger));
    auto exposure = SimulatedLine::open(trigger.chip, trigger.exposure_line);
    if (!exposure) return tl::unexpected(exposure.error());
    writer->exposure_.emplace(std::move(*exposure));
    if (trigger.pps_line) {
      auto pps = SimulatedLine::open(trigger.chip, *trigger.pps_line);
      if (!pps) return tl::unexpected(pps.error());
      writer->pps_.emplace(std::move(*pps));
    }
    if (trigger.active_low) writer->exposure_->pull(true);
    return writer;
  }

  int write(const Edge& edge) {
    if (edge.line == EdgeLine::kPps) return pps_ ? make(*pps_, edge.rising, true) : 0;
    return make(*exposure_, edge.rising != trigger_.active_low, !trigger_.exposure_active);
  }

 private:
  explicit EdgeWriter(TriggerConfig trigger) : trigger_(std::move(trigger)) {}

  // Of a line on which only one edge counts the other may not have been recorded.
  static int make(SimulatedLine& line, bool high, bool one_edge_counts) {
    if (one_edge_counts && line.is_high() == high) {
      if (const int status = line.pull(!high); status < 0) return status;
    }
    return line.pull(high);
  }

  TriggerConfig trigger_;
  std::optional<SimulatedLine> exposure_;
  std::optional<SimulatedLine> pps_;
};

PlayedDevice trigger_device(std::shared_ptr<EdgeWriter> lines) {
  return {
      .write = [lines = std::move(lines)](const RigEvent& event,
                                          HostTime) { return lines->write(std::get<Edge>(event)); },
      .name = "hil-edges",
      .fifo_priority = kEdgePriority,
      .events_ahead = kEdgesAhead};
}

PlayedDevice camera_device(std::shared_ptr<VideoOutput> output) {
  return {.write =
              [output = std::move(output)](const RigEvent& event, HostTime due) {
                const auto& frame = *std::get<std::shared_ptr<const CameraFrame>>(event);
                // The driver's stamp moves with the arrival.
                return output->write(frame, due - (frame.arrival - frame.driver_time));
              },
          .name = "hil-frames",
          .fifo_priority = kFramePriority,
          .events_ahead = kFramesAhead};
}

PlayedDevice lidar_device(std::shared_ptr<PacketSender> sender, const LidarConfig& lidar) {
  return {.write =
              [sender = std::move(sender), lidar](const RigEvent& event, HostTime) {
                if (const auto* packet = std::get_if<LidarPacket>(&event)) {
                  return sender->send(packet->payload, lidar.data_port);
                }
                return sender->send(std::get<PositionPacket>(event).payload, lidar.position_port);
              },
          .name = "hil-packets",
          .fifo_priority = kPacketPriority,
          .events_ahead = kPacketsAhead};
}

}  // namespace

RigConfig rig_on_devices(RigConfig recorded, const RigDeviceNames& names) {
  recorded.camera.device = names.camera;
  recorded.camera.exposure.reset();
  recorded.camera.gain.reset();
  recorded.camera.controls.clear();
  recorded.lidar.sensor_address = names.sensor_address;
  recorded.lidar.rpm.reset();
  recorded.lidar.phase_lock_deg.reset();
  recorded.trigger.chip = names.chip;
  recorded.trigger.pps_output_line.reset();
  recorded.trigger.nmea_device.clear();
  return recorded;
}

Result<DevicePlayer::Devices> open_rig_devices(const RigConfig& rig, const RigDeviceNames& names,
                                               const CameraFrame& like) {
  auto output =
      VideoOutput::open(names.camera_output.empty() ? names.camera : names.camera_output, like);
  if (!output) return tl::unexpected(output.error());
  auto sender = PacketSender::open(names.lidar_address);
  if (!sender) return tl::unexpected(sender.error());
  auto lines = EdgeWriter::open(rig.trigger);
  if (!lines) return tl::unexpected(lines.error());
  DevicePlayer::Devices devices;
  devices[static_cast<std::size_t>(DeviceKind::kCamera)] = camera_device(std::move(*output));
  devices[static_cast<std::size_t>(DeviceKind::kLidar)] =
      lidar_device(std::make_shared<PacketSender>(std::move(*sender)), rig.lidar);
  devices[static_cast<std::size_t>(DeviceKind::kTrigger)] = trigger_device(std::move(*lines));
  return devices;
}

}  // namespace sparsight
