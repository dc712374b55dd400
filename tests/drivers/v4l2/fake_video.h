#pragma once

#include <linux/videodev2.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "drivers/v4l2/system_calls.h"

namespace sparsight::testing {

// A camera as its driver shows it, on a clock of its own that only waiting moves. It delivers a
// frame per period into the buffers that are queued, loses those for which none is, and does what
// the script says of the n-th frame.
class FakeVideo final : public SystemCalls {
 public:
  struct Format {
    std::uint32_t fourcc;
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t stride;
    std::uint32_t bytes;
  };
  struct Control {
    std::string name;
    std::int64_t value;
    std::int64_t minimum = 0;
    std::int64_t maximum = 10000;
    std::uint32_t type = V4L2_CTRL_TYPE_INTEGER;
    std::int64_t step = 1;
  };
  // What happens instead of a good frame.
  struct Trouble {
    bool lost = false;
    bool error_flag = false;
    std::uint32_t missing_bytes = 0;
    int dequeue_errno = 0;  // and the stream is dead
    bool unplugged = false;
    bool source_changes = false;
    bool counts_from_zero = false;
  };

  std::vector<Format> formats{{V4L2_PIX_FMT_GREY, 800, 600, 800, 480000}};
  std::map<std::uint32_t, Control> controls;
  v4l2_fract slowest_period{1, 120};  // S_PARM cannot go below
  bool keeps_rate = true;
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::uint32_t timestamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  std::uint32_t most_buffers = 32;
  bool plugged = true;
  bool triggered = true;   // false: streams, but nothing triggers it
  int frames_to_come = 0;  // that are triggered all the same
  bool accepts_requeue = true;
  std::chrono::nanoseconds transfer = std::chrono::milliseconds(5);  // stamp to arrival
  std::map<int, Trouble> troubles;                                   // by the frame's number
  std::vector<std::string> opened;
  std::vector<std::pair<std::uint32_t, std::int64_t>> set_controls;
  std::uint32_t s_fmt_ignores_size_to = 0;  // the width that it gives instead

  int open_fds = 0;
  int mapped = 0;
  int frames_made = 0;
  HostTime clock{std::chrono::seconds(100)};

  int open(const std::string& path) override {
    opened.push_back(path);
    if (!plugged) return -ENOENT;
    ++open_fds;
    return 7;
  }
  void close(int) override {
    --open_fds;
    streaming_ = false;
    queued_.clear();
    full_.clear();
    events_ = 0;
  }
  void* map(int, std::size_t length, std::uint32_t offset) override {
    ++mapped;
    if (offset >= memory_.size()) return nullptr;
    memory_[offset].resize(length);
    return memory_[offset].data();
  }
  void unmap(void*, std::size_t) override { --mapped; }
  void sleep(std::chrono::nanoseconds duration) override { pass(duration); }
  HostTime now() override { return clock; }

  int poll(int, short, std::chrono::nanoseconds patience) override {
    const HostTime deadline = clock + patience;
    while (plugged && ready() == 0 && streaming_ && next_frame_ <= deadline) {
      clock = std::max(clock, next_frame_);
      next_frame_ += period();
      make_frame();
    }
    if (ready() == 0) clock = std::max(clock, deadline);
    return ready();
  }

  int ioctl(int, unsigned long request, void* argument) override {
    if (!plugged) return -ENODEV;
    switch (request) {
      case VIDIOC_QUERYCAP:
        return query(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT:
        return enumerate(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_S_FMT:
        return set(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
        return set(*static_cast<v4l2_streamparm*>(argument));
      case VIDIOC_QUERY_EXT_CTRL:
        return query(*static_cast<v4l2_query_ext_ctrl*>(argument));
      case VIDIOC_S_EXT_CTRLS:
      case VIDIOC_G_EXT_CTRLS:
        return access(request, *static_cast<v4l2_ext_controls*>(argument)->controls);
      case VIDIOC_REQBUFS:
        return provide(*static_cast<v4l2_requestbuffers*>(argument));
      case VIDIOC_QUERYBUF:
        return query(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_QBUF:
        if (!accepts_requeue && streaming_) return -EINVAL;
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return dequeue(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        streaming_ = true;
        sequence_ = 0;
        dead_ = 0;
        next_frame_ = clock + period();
        return 0;
      case VIDIOC_STREAMOFF:
        streaming_ = false;
        return 0;
      case VIDIOC_SUBSCRIBE_EVENT:
        return 0;
      case VIDIOC_DQEVENT:
        if (events_ == 0) return -ENOENT;
        --events_;
        static_cast<v4l2_event*>(argument)->type = V4L2_EVENT_SOURCE_CHANGE;
        return 0;
      default:
        return -ENOTTY;
    }
  }

  std::size_t queued() const { return queued_.size(); }
  // Time goes by in which nobody waits.
  void pass(std::chrono::nanoseconds duration) {
    const HostTime end = clock + duration;
    while (plugged && streaming_ && next_frame_ <= end) {
      clock = std::max(clock, next_frame_);
      next_frame_ += period();
      make_frame();
    }
    clock = end;
  }

 private:
  struct Full {
    std::uint32_t index;
    std::uint32_t sequence;
    std::uint32_t bytes;
    std::uint32_t flags;
    HostTime stamp;
  };

  std::chrono::nanoseconds period() const {
    return std::chrono::nanoseconds(1'000'000'000LL * period_.numerator / period_.denominator);
  }
  int ready() const {
    if (!plugged) return POLLERR | POLLHUP;
    int events = 0;
    if (!full_.empty() || dead_ != 0) events |= POLLIN;
    if (events_ > 0) events |= POLLPRI;
    return events;
  }

  void make_frame() {
    if (dead_ != 0 || (!triggered && frames_to_come <= 0)) return;
    --frames_to_come;
    const Trouble trouble = troubles[frames_made++];
    if (trouble.unplugged) plugged = false;
    if (trouble.source_changes) ++events_;
    dead_ = trouble.dequeue_errno;
    if (!plugged || dead_ != 0) return;
    if (trouble.counts_from_zero) sequence_ = 0;
    const std::uint32_t sequence = sequence_++;
    if (trouble.lost || queued_.empty()) return;
    const std::uint32_t index = queued_.front();
    queued_.pop_front();
    std::fill(memory_[index].begin(), memory_[index].end(),
              static_cast<std::uint8_t>(sequence + 1));
    const std::uint32_t bytes = format_.bytes - trouble.missing_bytes;
    full_.push_back(
        {index, sequence, bytes, trouble.error_flag ? V4L2_BUF_FLAG_ERROR : 0U, clock - transfer});
  }

  int query(v4l2_capability& capability) const {
    capability.capabilities = V4L2_CAP_DEVICE_CAPS;
    capability.device_caps = capabilities;
    return 0;
  }
  int enumerate(v4l2_fmtdesc& description) const {
    if (description.index >= formats.size()) return -EINVAL;
    description.pixelformat = formats[description.index].fourcc;
    return 0;
  }
  int set(v4l2_format& request) {
    for (const Format& format : formats) {
      if (format.fourcc != request.fmt.pix.pixelformat) continue;
      format_ = format;
      request.fmt.pix.width = format.width;
      request.fmt.pix.height = format.height;
      request.fmt.pix.bytesperline = format.stride;
      request.fmt.pix.sizeimage = format.bytes;
      return 0;
    }
    return -EINVAL;
  }
  int set(v4l2_streamparm& parameters) {
    if (!keeps_rate) return -ENOTTY;
    auto& asked = parameters.parm.capture.timeperframe;
    if (asked.numerator * slowest_period.denominator <
        slowest_period.numerator * asked.denominator) {
      asked = slowest_period;
    }
    period_ = asked;
    parameters.parm.capture.capability = V4L2_CAP_TIMEPERFRAME;
    return 0;
  }
  int query(v4l2_query_ext_ctrl& query) const {
    auto found = controls.find(query.id);
    if ((query.id & V4L2_CTRL_FLAG_NEXT_CTRL) != 0) {
      found = controls.upper_bound(query.id & ~std::uint32_t{V4L2_CTRL_FLAG_NEXT_CTRL});
    }
    if (found == controls.end()) return -EINVAL;
    query = {};
    query.id = found->first;
    query.type = found->second.type;
    std::strncpy(query.name, found->second.name.c_str(), sizeof(query.name) - 1);
    query.minimum = found->second.minimum;
    query.maximum = found->second.maximum;
    query.step = static_cast<std::uint64_t>(found->second.step);
    return 0;
  }
  int access(unsigned long request, v4l2_ext_control& holder) {
    const auto found = controls.find(holder.id);
    if (found == controls.end()) return -EINVAL;
    Control& control = found->second;
    const bool wide = control.type == V4L2_CTRL_TYPE_INTEGER64;
    if (request == VIDIOC_S_EXT_CTRLS) {
      const std::int64_t value = wide ? holder.value64 : holder.value;
      control.value = value / control.step * control.step;
      set_controls.emplace_back(found->first, value);
    } else if (wide) {
      holder.value64 = control.value;
    } else {
      holder.value = static_cast<std::int32_t>(control.value);
    }
    return 0;
  }
  int provide(v4l2_requestbuffers& request) {
    request.count = std::min(request.count, most_buffers);
    memory_.resize(std::max<std::size_t>(request.count, memory_.size()));
    queued_.clear();
    full_.clear();
    return 0;
  }
  int query(v4l2_buffer& buffer) const {
    buffer.length = format_.bytes;
    buffer.m.offset = buffer.index;
    return 0;
  }
  int dequeue(v4l2_buffer& buffer) {
    if (dead_ != 0) return -dead_;
    if (full_.empty()) return -EAGAIN;
    const Full full = full_.front();
    full_.pop_front();
    buffer.index = full.index;
    buffer.sequence = full.sequence;
    buffer.bytesused = full.bytes;
    buffer.flags = full.flags | timestamp_flags;
    const auto stamp = full.stamp.time_since_epoch();
    buffer.timestamp.tv_sec = stamp / std::chrono::seconds(1);
    buffer.timestamp.tv_usec = stamp % std::chrono::seconds(1) / std::chrono::microseconds(1);
    return 0;
  }

  Format format_{};
  v4l2_fract period_{1, 30};
  bool streaming_ = false;
  int dead_ = 0;
  int events_ = 0;
  std::uint32_t sequence_ = 0;
  HostTime next_frame_;
  std::deque<std::uint32_t> queued_;
  std::deque<Full> full_;
  std::vector<std::vector<std::uint8_t>> memory_;
};

}  // namespace sparsight::testing
