#include "drivers/datasets/capture_events.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/image_file.h"
#include "drivers/vlp16/data_packet.h"
#include "drivers/vlp16/position_packet.h"

namespace sparsight {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

// UTC of a stamp within the hour: of all hours that which comes nearest to the capture's clock.
HostTime utc_near(HostTime captured, std::uint32_t microseconds_past_hour) {
  const auto hour = std::chrono::floor<std::chrono::hours>(captured.time_since_epoch());
  const HostTime within(hour + std::chrono::microseconds(microseconds_past_hour));
  const nanoseconds off = within - captured;
  return off > 30min ? within - 1h : off < -30min ? within + 1h : within;
}

// Where the packet stands on the LiDAR's own clock; where it was captured, if it has no time.
HostTime on_lidar_clock(const LidarPacket& packet, nanoseconds packet_delay) {
  DataPacket reading;
  if (!read_data_packet(packet.payload, reading) || reading.sequence_count == 0) {
    return packet.arrival;
  }
  return utc_near(packet.arrival, reading.microseconds_past_hour) +
         firing_offset(reading.sequence_count - 1, kVlp16Lasers - 1) + packet_delay;
}

HostTime on_lidar_clock(const PositionPacket& packet, nanoseconds packet_delay) {
  const auto reading = read_position_packet(packet.payload);
  return reading ? utc_near(packet.arrival, reading->microseconds_past_hour) + packet_delay
                 : packet.arrival;
}

std::string seconds_text(HostTime time) {
  return fmt::format("{:.3f}", to_seconds(time.time_since_epoch()));
}

Error wrong_size(const std::string& file, const GreyImage& image, const CameraIntrinsics& camera) {
  return {ErrorCode::kWrongSize,
          fmt::format("{}: {} x {} pixels, but the calibration is for {} x {}", file, image.width,
                      image.height, camera.width, camera.height)};
}

Result<DecodedImage> read_image(const std::filesystem::path& file, const CameraIntrinsics& camera) {
  auto image = read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return decode_image(bytes, file.string()); });
  if (image && (image->grey.width != camera.width || image->grey.height != camera.height)) {
    return tl::unexpected(wrong_size(file.string(), image->grey, camera));
  }
  return image;
}

}  // namespace

Result<std::unique_ptr<CaptureEvents>> CaptureEvents::open(CaptureFolder folder,
                                                           const LidarConfig& lidar,
                                                           const CameraIntrinsics& camera,
                                                           const CaptureOptions& options) {
  std::unique_ptr<CaptureEvents> events(
      new CaptureEvents(std::move(folder), lidar, camera, options));
  // One image that cannot be read is a fault of its frame, a wrong size of the first is all of
  // theirs.
  const auto first = read_image(events->folder_.images.front(), camera);
  if (!first && first.error().code == ErrorCode::kWrongSize) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}; see [calibration.camera] of {}", first.error().message,
                            events->folder_.rig.string()));
  }
  if (auto surveyed = events->survey(); !surveyed) return tl::unexpected(surveyed.error());
  return events;
}

CaptureEvents::CaptureEvents(CaptureFolder folder, const LidarConfig& lidar,
                             const CameraIntrinsics& camera, const CaptureOptions& options)
    : folder_(std::move(folder)),
      camera_(camera),
      options_(options),
      lidar_(folder_.capture, lidar) {}

Result<void> CaptureEvents::survey() {
  if (auto started = lidar_.start(); !started) return started;
  while (const auto event = next_packet()) {
    if (const auto* position = std::get_if<PositionPacket>(&*event)) {
      ++summary_.positions;
      const auto reading = read_position_packet(position->payload);
      summary_.hour_is_utc = summary_.hour_is_utc || (reading && hour_is_utc(*reading));
      continue;
    }
    if (summary_.packets++ == 0) summary_.first = arrival_of(*event);
    summary_.last = arrival_of(*event);
  }
  summary_.damage = lidar_.damage();
  if (auto fits = check_times(); !fits) return fits;
  lidar_.stop();
  last_arrival_ = HostTime::min();
  if (auto started = lidar_.start(); !started) return started;
  packet_ = next_packet();
  return {};
}

Result<void> CaptureEvents::check_times() const {
  const std::string capture = folder_.capture.string();
  if (summary_.packets == 0) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no data packets of a VLP-16 in it; [lidar] data_port of {} says "
                            "which port they go to",
                            capture, folder_.rig.string()));
  }
  if (folder_.clock == CaptureClock::kLidar && summary_.positions > 0 && !summary_.hour_is_utc) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("{}: says \"clock: lidar\", but the LiDAR of {} never had its hour from "
                    "PPS and NMEA: its clock ran free",
                    folder_.times_file.string(), capture));
  }
  const auto outside = [&](HostTime t) { return t < summary_.first || t > summary_.last; };
  const auto& times = folder_.exposures;
  const auto count = static_cast<std::size_t>(std::ranges::count_if(times, outside));
  if (2 * count <= times.size()) return {};
  const auto line = std::ranges::find_if(times, outside);
  return fail(
      ErrorCode::kOutOfRange,
      fmt::format("{}: {} of {} times, {} s for the first, lie outside {}, which lasts from "
                  "{} to {} s; they are seconds since 1970 by the clock of the machine that "
                  "captured, or with \"# clock: lidar\" above them by the LiDAR's own",
                  folder_.times_file.string(), count, times.size(), seconds_text(*line), capture,
                  seconds_text(summary_.first), seconds_text(summary_.last)));
}

std::optional<RigEvent> CaptureEvents::next_packet() {
  auto message = lidar_.read(nanoseconds(0));
  if (!message) return std::nullopt;
  return std::visit(
      [this](auto& packet) -> RigEvent {
        if (folder_.clock == CaptureClock::kLidar) {
          packet.arrival = on_lidar_clock(packet, options_.packet_delay);
        }
        // What the network put out of its order came when it came.
        packet.arrival = last_arrival_ = std::max(packet.arrival, last_arrival_);
        return packet;
      },
      *message);
}

std::optional<RigEvent> CaptureEvents::next() {
  const bool images_left = next_image_ < folder_.images.size();
  if (!packet_ && !images_left) return std::nullopt;
  if (images_left &&
      (!packet_ || folder_.exposures[next_image_] + options_.frame_delay <= arrival_of(*packet_))) {
    return frame(next_image_++);
  }
  return std::exchange(packet_, next_packet());
}

std::shared_ptr<const CameraFrame> CaptureEvents::frame(std::uint32_t number) {
  auto frame = std::make_shared<CameraFrame>();
  frame->sequence = number;
  frame->driver_time = folder_.exposures[number];
  frame->arrival = frame->driver_time + options_.frame_delay;
  frame->width = camera_.width;
  frame->height = camera_.height;
  auto image = read_image(folder_.images[number], camera_);
  if (!image) {
    frame->damaged = true;
    image_faults_.emplace(number, std::move(image.error()));
  } else if (image->color) {
    frame->format = PixelFormat::kRgb8;
    frame->stride_bytes = 3 * camera_.width;
    frame->bytes = std::move(image->color->rgb);
  } else {
    frame->stride_bytes = camera_.width;
    frame->bytes = std::move(image->grey.pixels);
  }
  return frame;
}

}  // namespace sparsight
