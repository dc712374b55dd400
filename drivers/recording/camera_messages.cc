#include "drivers/recording/camera_messages.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "drivers/recording/ros_header.h"

namespace sparsight {
namespace {

struct Encoding {
  PixelFormat format;
  std::string_view ros;  // sensor_msgs/image_encodings.hpp
};

// Where two formats share a name, what is read back is the last of them.
constexpr Encoding kEncodings[] = {
    {PixelFormat::kGrey8, "mono8"},
    {PixelFormat::kGrey10, "mono16"},
    {PixelFormat::kGrey12, "mono16"},
    {PixelFormat::kGrey16, "mono16"},
    {PixelFormat::kBayerRggb8, "bayer_rggb8"},
    {PixelFormat::kBayerGrbg8, "bayer_grbg8"},
    {PixelFormat::kBayerGbrg8, "bayer_gbrg8"},
    {PixelFormat::kBayerBggr8, "bayer_bggr8"},
    {PixelFormat::kYuyv, "yuv422_yuy2"},
    {PixelFormat::kUyvy, "yuv422"},
    {PixelFormat::kNv12, "nv12"},
    {PixelFormat::kRgb8, "rgb8"},
    {PixelFormat::kMjpeg, "jpeg"},
};

std::optional<PixelFormat> format_of(std::string_view ros) {
  std::optional<PixelFormat> found;
  for (const Encoding& encoding : kEncodings) {
    if (encoding.ros == ros) found = encoding.format;
  }
  return found;
}

std::uint32_t unsigned_or_zero(int value) { return static_cast<std::uint32_t>(std::max(value, 0)); }

std::int64_t count_of(HostTime time) { return time.time_since_epoch().count(); }

HostTime host_time(std::int64_t ns) { return HostTime(std::chrono::nanoseconds(ns)); }

bool fits_int(std::uint32_t value) {
  return value <= static_cast<std::uint32_t>(std::numeric_limits<int>::max());
}

template <std::size_t N>
void append_numbers(const double (&values)[N], CdrWriter& writer) {
  for (const double value : values) writer.number(value);
}

}  // namespace

std::string_view ros_encoding(PixelFormat format) {
  return std::ranges::find(kEncodings, format, &Encoding::format)->ros;
}

void append_image(const CameraFrame& frame, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_header({frame.driver_time, kCameraFrame}, writer);
  writer.number(unsigned_or_zero(frame.height));
  writer.number(unsigned_or_zero(frame.width));
  writer.text(ros_encoding(frame.format));
  writer.number(std::uint8_t{0});  // is_bigendian
  writer.number(unsigned_or_zero(frame.stride_bytes));
  writer.sequence(frame.bytes);
}

void append_compressed_image(const CameraFrame& frame, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_header({frame.driver_time, kCameraFrame}, writer);
  writer.text(ros_encoding(frame.format));
  writer.sequence(frame.bytes);
}

void append_frame_info(const CameraFrame& frame, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  writer.number(frame.sequence);
  writer.number(frame.epoch);
  writer.number(count_of(frame.driver_time));
  writer.number(count_of(frame.arrival));
  writer.number(std::int64_t{frame.exposure.count()});
  writer.boolean(frame.damaged);
  writer.number(static_cast<std::uint8_t>(frame.format));
  writer.number(std::int32_t{frame.width});
  writer.number(std::int32_t{frame.height});
  writer.number(std::int32_t{frame.stride_bytes});
}

void append_camera_info(const CameraIntrinsics& camera, HostTime stamp,
                        std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_header({stamp, kCameraFrame}, writer);
  writer.number(unsigned_or_zero(camera.height));
  writer.number(unsigned_or_zero(camera.width));
  writer.text("plumb_bob");
  writer.length(5);
  append_numbers({camera.k1, camera.k2, camera.p1, camera.p2, camera.k3}, writer);
  append_numbers({camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0}, writer);
  append_numbers({1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, writer);
  append_numbers(
      {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0}, writer);
  for (int i = 0; i < 6; ++i) writer.number(std::uint32_t{0});  // binning, region: all of it
  writer.boolean(false);
}

bool read_frame_info(Bytes message, CameraFrame& frame) {
  CdrReader reader(message);
  frame.sequence = reader.number<std::uint32_t>();
  frame.epoch = reader.number<std::uint32_t>();
  frame.driver_time = host_time(reader.number<std::int64_t>());
  frame.arrival = host_time(reader.number<std::int64_t>());
  frame.exposure = std::chrono::nanoseconds(reader.number<std::int64_t>());
  frame.damaged = reader.boolean();
  const auto format = reader.number<std::uint8_t>();
  frame.format = static_cast<PixelFormat>(format);
  frame.width = reader.number<std::int32_t>();
  frame.height = reader.number<std::int32_t>();
  frame.stride_bytes = reader.number<std::int32_t>();
  return reader.ok() && format < std::size(kEncodings);
}

bool read_image_bytes(Bytes message, CameraFrame& frame) {
  CdrReader reader(message);
  read_header(reader);
  reader.number<std::uint32_t>();
  reader.number<std::uint32_t>();
  reader.text();
  reader.number<std::uint8_t>();
  reader.number<std::uint32_t>();
  const Bytes bytes = reader.sequence();
  frame.bytes.assign(bytes.begin(), bytes.end());
  return reader.ok();
}

bool read_compressed_bytes(Bytes message, CameraFrame& frame) {
  CdrReader reader(message);
  read_header(reader);
  reader.text();
  const Bytes bytes = reader.sequence();
  frame.bytes.assign(bytes.begin(), bytes.end());
  return reader.ok();
}

bool read_foreign_image(Bytes message, CameraFrame& frame) {
  CdrReader reader(message);
  frame.driver_time = read_header(reader).stamp;
  const auto height = reader.number<std::uint32_t>();
  const auto width = reader.number<std::uint32_t>();
  const std::optional<PixelFormat> format = format_of(reader.text());
  const bool big_endian = reader.boolean();
  const auto stride = reader.number<std::uint32_t>();
  const Bytes bytes = reader.sequence();
  if (!reader.ok() || !format || big_endian || !fits_int(height) || !fits_int(width) ||
      !fits_int(stride)) {
    return false;
  }
  frame.format = *format;
  frame.height = static_cast<int>(height);
  frame.width = static_cast<int>(width);
  frame.stride_bytes = static_cast<int>(stride);
  frame.damaged = bytes.size() < std::uint64_t{stride} * height;
  frame.bytes.assign(bytes.begin(), bytes.end());
  return true;
}

}  // namespace sparsight
