#pragma once

#include <linux/videodev2.h>

#include <optional>
#include <string_view>
#include <vector>

#include "drivers/v4l2/video_device.h"

namespace sparsight {

// The settings that a camera has, as its driver lists them.
class ControlList {
 public:
  explicit ControlList(VideoDevice& device);

  const v4l2_query_ext_ctrl* find(std::uint32_t id) const;
  // By number ("0x009a0901"), by the driver's name ("Exposure, Auto") or as v4l2-ctl writes that
  // ("exposure_auto").
  const v4l2_query_ext_ctrl* find(std::string_view name) const;

  std::optional<std::int64_t> get(const v4l2_query_ext_ctrl& control);
  // The value in force afterwards. Fails if the camera refuses it or keeps another.
  Result<std::int64_t> set(const v4l2_query_ext_ctrl& control, std::int64_t value);

  std::string names() const;
  const VideoDevice& device() const { return device_; }

 private:
  VideoDevice& device_;
  std::vector<v4l2_query_ext_ctrl> controls_;
};

}  // namespace sparsight
