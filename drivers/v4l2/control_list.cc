#include "drivers/v4l2/control_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace sparsight {
namespace {

constexpr std::size_t kMaxControls = 1024;  // a driver that never ends its list

std::string_view name_of(const v4l2_query_ext_ctrl& control) {
  const std::string_view name(control.name, sizeof(control.name));
  return name.substr(0, name.find('\0'));
}

// "Exposure, Auto" and "exposure_auto" are one.
std::string plain(std::string_view name) {
  std::string text;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!text.empty() && text.back() != '_') {
      text += '_';
    }
  }
  return text;
}

std::optional<std::uint32_t> number_of(std::string_view name) {
  if (!name.starts_with("0x") && !name.starts_with("0X")) return std::nullopt;
  std::uint32_t id = 0;
  const auto [end, error] = std::from_chars(name.data() + 2, name.data() + name.size(), id, 16);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return id;
}

// A value that does not fit into 32 bits has a field of its own.
v4l2_ext_control value_holder(const v4l2_query_ext_ctrl& control, std::int64_t value) {
  v4l2_ext_control holder{};
  holder.id = control.id;
  if (control.type == V4L2_CTRL_TYPE_INTEGER64) {
    holder.value64 = value;
  } else {
    holder.value = static_cast<std::int32_t>(value);
  }
  return holder;
}

v4l2_ext_controls single(v4l2_ext_control& holder) {
  v4l2_ext_controls controls{};
  controls.which = V4L2_CTRL_WHICH_CUR_VAL;
  controls.count = 1;
  controls.controls = &holder;
  return controls;
}

}  // namespace

ControlList::ControlList(VideoDevice& device) : device_(device) {
  v4l2_query_ext_ctrl control{};
  control.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (controls_.size() < kMaxControls && device_.call(VIDIOC_QUERY_EXT_CTRL, control) == 0) {
    if ((control.flags & V4L2_CTRL_FLAG_DISABLED) == 0) controls_.push_back(control);
    control.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
}

const v4l2_query_ext_ctrl* ControlList::find(std::uint32_t id) const {
  const auto match = std::find_if(controls_.begin(), controls_.end(),
                                  [&](const auto& control) { return control.id == id; });
  return match == controls_.end() ? nullptr : &*match;
}

const v4l2_query_ext_ctrl* ControlList::find(std::string_view name) const {
  if (const auto id = number_of(name)) return find(*id);
  const auto match = std::find_if(controls_.begin(), controls_.end(), [&](const auto& control) {
    return plain(name_of(control)) == plain(name);
  });
  return match == controls_.end() ? nullptr : &*match;
}

std::optional<std::int64_t> ControlList::get(const v4l2_query_ext_ctrl& control) {
  v4l2_ext_control holder = value_holder(control, 0);
  v4l2_ext_controls controls = single(holder);
  if (device_.call(VIDIOC_G_EXT_CTRLS, controls) < 0) return std::nullopt;
  if (control.type == V4L2_CTRL_TYPE_INTEGER64) return std::int64_t{holder.value64};
  if (control.type == V4L2_CTRL_TYPE_BITMASK) return static_cast<std::uint32_t>(holder.value);
  return std::int64_t{holder.value};
}

Result<std::int64_t> ControlList::set(const v4l2_query_ext_ctrl& control, std::int64_t value) {
  const std::string what = fmt::format("control \"{}\" = {}", name_of(control), value);
  const bool unsigned_bits = control.type == V4L2_CTRL_TYPE_BITMASK;
  if (!unsigned_bits && (value < control.minimum || value > control.maximum)) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: {}: must be between {} and {}, in steps of {}", device_.path(),
                            what, control.minimum, control.maximum, control.step));
  }
  v4l2_ext_control holder = value_holder(control, value);
  v4l2_ext_controls controls = single(holder);
  if (const int status = device_.call(VIDIOC_S_EXT_CTRLS, controls); status < 0) {
    return tl::unexpected(device_.error(what + " is refused", status));
  }
  const bool silent =
      control.type == V4L2_CTRL_TYPE_BUTTON || (control.flags & V4L2_CTRL_FLAG_WRITE_ONLY) != 0;
  if (silent) return value;
  const auto in_force = get(control);
  if (in_force && *in_force != value) {
    return fail(ErrorCode::kOutOfRange, fmt::format("{}: {}: the camera keeps {}; its steps are {}",
                                                    device_.path(), what, *in_force, control.step));
  }
  return value;
}

std::string ControlList::names() const {
  std::string text;
  for (const auto& control : controls_) {
    if (control.type == V4L2_CTRL_TYPE_CTRL_CLASS) continue;
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name_of(control));
  }
  return text;
}

}  // namespace sparsight
