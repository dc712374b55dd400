#include "drivers/v4l2/video_device.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace sparsight {
namespace {

std::string_view remedy(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "; is the camera plugged in? ls /dev/v4l/by-id /dev/v4l/by-path shows those there are";
    case EACCES:
    case EPERM:
      return "; the user must belong to the group video";
    case EBUSY:
      return "; another program uses the camera: fuser shows which";
    default:
      return "";
  }
}

ErrorCode code_of_errno(int error_number) {
  const bool absent = error_number == ENOENT || error_number == ENODEV || error_number == ENXIO;
  return absent ? ErrorCode::kNotFound : ErrorCode::kUnreadable;
}

Error system_error(const std::string& path, std::string_view what, int negative_errno) {
  const int number = -negative_errno;
  return {code_of_errno(number),
          fmt::format("{}: {}: {}{}", path, what, std::generic_category().message(number),
                      remedy(number))};
}

}  // namespace

Result<VideoDevice> VideoDevice::open(SystemCalls& calls, const std::string& path,
                                      std::uint32_t ability) {
  const int fd = calls.open(path);
  if (fd < 0) return tl::unexpected(system_error(path, "cannot open the camera", fd));
  VideoDevice device(calls, path, fd);
  v4l2_capability capability{};
  if (const int status = device.call(VIDIOC_QUERYCAP, capability); status < 0) {
    return tl::unexpected(device.error("is no video device", status));
  }
  const std::uint32_t abilities = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                      ? capability.device_caps
                                      : capability.capabilities;
  const std::uint32_t needed = ability | V4L2_CAP_STREAMING;
  if ((abilities & needed) != needed) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: does not stream single-plane video {}; a device often has several "
                            "nodes, of which one does: v4l2-ctl --list-devices",
                            path, ability == V4L2_CAP_VIDEO_OUTPUT ? "out" : "in"));
  }
  return device;
}

VideoDevice::~VideoDevice() {
  if (fd_ >= 0) calls_.close(fd_);
}

VideoDevice::VideoDevice(VideoDevice&& other) noexcept
    : calls_(other.calls_), path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)) {}

Error VideoDevice::error(std::string_view what, int negative_errno) const {
  return system_error(path_, what, negative_errno);
}

}  // namespace sparsight
