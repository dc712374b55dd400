#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "hal/device.h"
#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

// What the bytes of a frame are; names and layouts as in V4L2 (Linux media documentation, "Image
// Formats"). Listed in the order a camera is asked for them.
enum class PixelFormat : std::uint8_t {
  kGrey8,   // GREY
  kGrey10,  // Y10: little-endian 16 bit, value in the low 10 bits
  kGrey12,  // Y12
  kGrey16,  // Y16
  kBayerRggb8,
  kBayerGrbg8,
  kBayerGbrg8,
  kBayerBggr8,
  kYuyv,
  kUyvy,
  kNv12,
  kRgb8,  // RGB3
  kMjpeg,
};

// A frame as the camera delivered it, before anyone interprets it. Its time is not here:
// `driver_time` is only good for finding the exposure edge that belongs to it.
struct CameraFrame {
  std::uint32_t sequence = 0;  // the driver's count; a gap is frames lost before they reached us
  std::uint32_t epoch = 0;     // counts restarts of streaming; sequences of two do not compare
  HostTime driver_time;        // V4L2 buffer timestamp, on CLOCK_MONOTONIC
  HostTime arrival;            // when it was taken from the driver
  std::chrono::nanoseconds exposure{0};  // exposure time in force; 0 where it is not known
  bool damaged = false;  // the driver's error flag, or fewer bytes than the format needs
  PixelFormat format = PixelFormat::kGrey8;
  int width = 0;
  int height = 0;
  int stride_bytes = 0;  // of the first plane; 0 for kMjpeg
  std::vector<std::uint8_t> bytes;
};

struct CameraCounters {
  std::uint64_t frames = 0;
  std::uint64_t lost = 0;     // gaps in the sequence
  std::uint64_t damaged = 0;  // error flag or short buffer
  std::uint64_t restarts = 0;
};

// A camera that delivers frames as they come. Thread-bound.
class Camera {
 public:
  virtual ~Camera() = default;
  // Opens the device, agrees on a format, applies the controls, streams.
  virtual Result<void> start() = 0;
  // The next frame; nothing if none comes within `patience` or the device is not streaming: state()
  // says which. A device that went away is looked for again within this call.
  virtual std::optional<CameraFrame> read(std::chrono::nanoseconds patience) = 0;
  virtual void stop() = 0;
  virtual DeviceState state() const = 0;
  // The folder under /sys of the hardware that its data come by; "" where there is none.
  virtual std::filesystem::path system_folder() const { return {}; }
  virtual CameraCounters counters() const = 0;
};

}  // namespace sparsight
