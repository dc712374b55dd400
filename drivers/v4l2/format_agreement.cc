#include "drivers/v4l2/format_agreement.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <vector>

#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

constexpr int kMaxFormats = 256;  // a driver that never ends its list

struct OfferedFormats {
  std::vector<PixelFormat> known;  // in the order of PixelFormat
  std::string names;               // of all, for people
};

OfferedFormats offered_formats(VideoDevice& device) {
  OfferedFormats offered;
  v4l2_fmtdesc description{};
  description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (int i = 0; i < kMaxFormats && device.call(VIDIOC_ENUM_FMT, description) == 0; ++i) {
    std::string name;
    for (int shift = 0; shift < 32; shift += 8) {
      const auto c = static_cast<char>(description.pixelformat >> shift & 0x7FU);
      if (c > ' ') name += c;
    }
    offered.names += (offered.names.empty() ? "" : ", ") + name;
    if (const auto format = format_of(description.pixelformat)) offered.known.push_back(*format);
    ++description.index;
  }
  std::sort(offered.known.begin(), offered.known.end());
  return offered;
}

// What is wrong with the driver's answer; "" if nothing.
std::string disagreement(const v4l2_pix_format& given, const CameraConfig& config,
                         PixelFormat format) {
  if (format_of(given.pixelformat) != format) return "turns into another format";
  if (given.width != static_cast<std::uint32_t>(config.width) ||
      given.height != static_cast<std::uint32_t>(config.height)) {
    return fmt::format("comes at {}x{}", given.width, given.height);
  }
  if (given.field != V4L2_FIELD_NONE && given.field != V4L2_FIELD_ANY) return "is interlaced";
  constexpr std::uint32_t kMostBytes = 1U << 30U;
  if (given.bytesperline > kMostBytes || given.sizeimage > kMostBytes) return "has absurd sizes";
  if (format == PixelFormat::kMjpeg) return given.sizeimage == 0 ? "has buffers of size 0" : "";
  const int stride = std::max(static_cast<int>(given.bytesperline), 1);
  if (given.bytesperline != 0 && stride < row_bytes(format, config.width)) {
    return fmt::format("has rows of {} bytes only", stride);
  }
  const int rows = given.bytesperline == 0 ? row_bytes(format, config.width) : stride;
  if (given.sizeimage < frame_bytes(format, rows, config.height)) {
    return fmt::format("has buffers of {} bytes only", given.sizeimage);
  }
  return "";
}

v4l2_format request_for(PixelFormat format, const CameraConfig& config) {
  v4l2_format request{};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.fmt.pix.width = static_cast<std::uint32_t>(config.width);
  request.fmt.pix.height = static_cast<std::uint32_t>(config.height);
  request.fmt.pix.pixelformat = code_of(format).fourcc;
  request.fmt.pix.field = V4L2_FIELD_NONE;
  return request;
}

Result<AgreedFormat> try_in_order(VideoDevice& device, const CameraConfig& config,
                                  const std::vector<PixelFormat>& candidates) {
  std::string refusals;
  for (const PixelFormat format : candidates) {
    v4l2_format request = request_for(format, config);
    const int status = device.call(VIDIOC_S_FMT, request);
    if (status == -EBUSY || status == -ENODEV) {
      return tl::unexpected(device.error("cannot set the format", status));
    }
    const v4l2_pix_format& given = request.fmt.pix;
    const std::string wrong = status < 0 ? "is refused" : disagreement(given, config, format);
    if (wrong.empty()) {
      AgreedFormat agreed{.format = format, .width = config.width, .height = config.height};
      if (format != PixelFormat::kMjpeg) {
        agreed.stride_bytes = given.bytesperline == 0 ? row_bytes(format, config.width)
                                                      : static_cast<int>(given.bytesperline);
      }
      return agreed;
    }
    refusals += fmt::format("{}{} {}", refusals.empty() ? "" : ", ", code_of(format).name, wrong);
  }
  return fail(ErrorCode::kWrongSize,
              fmt::format("{}: does not deliver {}x{}: {}; set [camera] width, height and format "
                          "to what v4l2-ctl --list-formats-ext shows",
                          device.path(), config.width, config.height, refusals));
}

// The rate that the driver says it keeps; 0 if it has no say in it, as with external triggers.
double set_rate(VideoDevice& device, double rate_hz) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_fract& period = parameters.parm.capture.timeperframe;
  const bool whole = rate_hz == std::round(rate_hz);
  period.numerator = whole ? 1 : 1000;
  period.denominator = static_cast<std::uint32_t>(std::lround(whole ? rate_hz : rate_hz * 1000.0));
  if (device.call(VIDIOC_S_PARM, parameters) < 0) return 0.0;
  if ((parameters.parm.capture.capability & V4L2_CAP_TIMEPERFRAME) == 0) return 0.0;
  if (period.numerator == 0) return 0.0;
  return static_cast<double>(period.denominator) / period.numerator;
}

}  // namespace

Result<AgreedFormat> agree_on_format(VideoDevice& device, const CameraConfig& config) {
  const OfferedFormats offered = offered_formats(device);
  std::vector<PixelFormat> candidates = offered.known;
  if (const auto wanted = format_named(config.format)) {
    std::erase_if(candidates, [&](PixelFormat format) { return format != *wanted; });
  }
  if (candidates.empty()) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: [camera] format = \"{}\" is not among what it offers ({})",
                            device.path(), config.format, offered.names));
  }
  auto agreed = try_in_order(device, config, candidates);
  if (!agreed) return agreed;
  agreed->rate_hz = set_rate(device, config.rate_hz);
  constexpr double kTolerance = 0.99;  // 29.97 Hz are 30
  if (agreed->rate_hz != 0.0 && agreed->rate_hz < kTolerance * config.rate_hz) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: gives {:.4g} Hz as {} {}x{}, not {:.4g}; set [camera] rate_hz or "
                            "another format",
                            device.path(), agreed->rate_hz, code_of(agreed->format).name,
                            config.width, config.height, config.rate_hz));
  }
  return agreed;
}

}  // namespace sparsight
