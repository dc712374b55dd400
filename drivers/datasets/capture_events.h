#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "drivers/datasets/capture_folder.h"
#include "drivers/vlp16/pcap_lidar.h"
#include "hal/calibration.h"
#include "hal/result.h"
#include "hal/rig_event.h"

namespace sparsight {

struct CaptureOptions {
  // When a frame takes its place among the packets: half a turn of the head after its exposure, so
  // that as much of the last turn lies before it as after.
  std::chrono::nanoseconds frame_delay{50'000'000};
  // From a packet's last firing until it would have been captured, for packets that are put on the
  // LiDAR's own clock. That of whoever maps the clocks.
  std::chrono::nanoseconds packet_delay{0};
};

// What was found in the capture from end to end.
struct CaptureSummary {
  std::uint64_t packets = 0;
  std::uint64_t positions = 0;
  bool hour_is_utc = false;  // a position packet says so
  HostTime first;            // on the clock of the images
  HostTime last;
  std::size_t images_within = 0;
  std::string damage;  // of the file's end
};

// The packets and images of a capture folder as the raw events of a rig, in the order of their
// arrival, on the clock that the images' times are of. A frame's driver_time is the middle of its
// exposure. Thread-bound.
class CaptureEvents final : public RigEventSource {
 public:
  // Goes through the capture once. Refused where images and capture do not belong together.
  static Result<std::unique_ptr<CaptureEvents>> open(CaptureFolder folder, const LidarConfig& lidar,
                                                     const CameraIntrinsics& camera,
                                                     const CaptureOptions& options = {});

  std::optional<RigEvent> next() override;

  const CaptureSummary& summary() const { return summary_; }
  // Why the image of the frame of this sequence could not be read; the frame is marked as damaged.
  const std::map<std::uint32_t, Error>& image_faults() const { return image_faults_; }

 private:
  CaptureEvents(CaptureFolder folder, const LidarConfig& lidar, const CameraIntrinsics& camera,
                const CaptureOptions& options);

  Result<void> survey();
  Result<void> check_times() const;
  std::optional<RigEvent> next_packet();
  std::shared_ptr<const CameraFrame> frame(std::uint32_t number);

  const CaptureFolder folder_;
  const CameraIntrinsics camera_;
  const CaptureOptions options_;
  PcapLidar lidar_;
  CaptureSummary summary_;
  std::optional<RigEvent> packet_;  // the next one
  HostTime last_arrival_{HostTime::min()};
  std::uint32_t next_image_ = 0;
  std::map<std::uint32_t, Error> image_faults_;
};

}  // namespace sparsight
