#include "drivers/v4l2/v4l2_camera.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "drivers/v4l2/frame_of_buffer.h"

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMostWaiting = 32;  // about a second of 30 Hz
constexpr nanoseconds kBetweenAttempts = std::chrono::milliseconds(200);
constexpr double kSilentPeriods = 5.0;

}  // namespace

V4l2Camera::V4l2Camera(CameraConfig config, SystemCalls& calls)
    : config_(std::move(config)), calls_(calls) {}

V4l2Camera::~V4l2Camera() = default;

Result<void> V4l2Camera::start() {
  if (state_ != DeviceState::kStopped) return {};
  return begin_stream();
}

Result<void> V4l2Camera::begin_stream() {
  auto stream = VideoStream::start(calls_, config_);
  if (!stream) return tl::unexpected(stream.error());
  stream_ = std::move(*stream);
  format_ = stream_->format();
  exposure_ = stream_->exposure();
  epoch_ = streams_++;
  last_sequence_.reset();
  last_sign_of_life_ = calls_.now();
  state_ = DeviceState::kStreaming;
  return {};
}

void V4l2Camera::stop() {
  stream_.reset();
  waiting_.clear();
  state_ = DeviceState::kStopped;
}

std::optional<CameraFrame> V4l2Camera::read(nanoseconds patience) {
  if (state_ == DeviceState::kStopped) return std::nullopt;
  const HostTime deadline = calls_.now() + patience;
  for (;;) {
    const nanoseconds left = std::max(deadline - calls_.now(), nanoseconds(0));
    advance(waiting_.empty() ? left : nanoseconds(0));
    if (!waiting_.empty()) break;
    if (calls_.now() >= deadline) {
      note_silence();
      return std::nullopt;
    }
  }
  CameraFrame frame = std::move(waiting_.front());
  waiting_.pop_front();
  ++counters_.frames;
  return frame;
}

// The path may be a link that names the camera by where it is plugged in.
std::filesystem::path V4l2Camera::system_folder() const {
  std::error_code error;
  const auto node = std::filesystem::canonical(config_.device, error);
  if (error) return {};
  return "/sys/class/video4linux" / node.filename();
}

void V4l2Camera::advance(nanoseconds patience) {
  if (!stream_) return look_for_device(patience);
  const int ready = stream_->poll(patience);
  if (ready == 0) return;
  if (ready < 0) return end_stream("cannot wait for frames", ready);
  if ((ready & POLLPRI) != 0 && stream_->source_changed()) {
    return end_stream("the source has changed its format", 0);
  }
  if ((ready & POLLIN) != 0) return take_frames();
  if ((ready & (POLLERR | POLLHUP | POLLNVAL)) != 0) {
    // Dequeuing says what the matter is.
    take_frames();
    if (stream_) end_stream("the driver has stopped streaming", -EIO);
  }
}

void V4l2Camera::look_for_device(nanoseconds patience) {
  const HostTime now = calls_.now();
  if (now < next_attempt_) return calls_.sleep(std::min(patience, next_attempt_ - now));
  next_attempt_ = now + kBetweenAttempts;
  if (auto begun = begin_stream(); !begun) {
    state_ = DeviceState::kGone;
    last_fault_ = begun.error().message;
    return;
  }
  ++counters_.restarts;
}

void V4l2Camera::take_frames() {
  v4l2_buffer buffer{};
  for (std::size_t i = 0; i < stream_->buffers(); ++i) {
    if (const int status = stream_->dequeue(buffer); status == -EAGAIN) {
      return;
    } else if (status < 0) {
      return end_stream("cannot take a frame", status);
    }
    take(buffer);
    if (const int status = stream_->queue(buffer); status < 0) {
      return end_stream("cannot give a buffer back", status);
    }
  }
}

void V4l2Camera::take(const v4l2_buffer& buffer) {
  const HostTime arrival = calls_.now();
  last_sign_of_life_ = arrival;
  state_ = DeviceState::kStreaming;
  count_sequence(buffer.sequence);
  CameraFrame frame;
  frame.bytes = spare_bytes();
  frame_of_buffer(buffer, stream_->memory(buffer), format_, arrival, frame);
  frame.epoch = epoch_;
  frame.exposure = exposure_;
  if (frame.damaged) ++counters_.damaged;
  if (waiting_.size() >= kMostWaiting) {
    recycle(std::move(waiting_.front().bytes));
    waiting_.pop_front();
    ++counters_.lost;
  }
  waiting_.push_back(std::move(frame));
}

// A driver that counts from 0 again has restarted by itself.
void V4l2Camera::count_sequence(std::uint32_t sequence) {
  if (last_sequence_) {
    const auto step = static_cast<std::int32_t>(sequence - *last_sequence_);
    if (step < 0) epoch_ = streams_++;
    if (step > 1) counters_.lost += static_cast<std::uint64_t>(step - 1);
  }
  last_sequence_ = sequence;
}

// The next attempt is made at once unless this stream has been none: then it would be made for
// ever.
void V4l2Camera::end_stream(std::string_view what, int negative_errno) {
  last_fault_ = fmt::format("{}: {}", config_.device, what);
  if (negative_errno < 0) {
    last_fault_ += ": " + std::generic_category().message(-negative_errno);
  }
  const bool unplugged = negative_errno == -ENODEV;
  const bool delivered = last_sequence_.has_value();
  stream_.reset();
  state_ = unplugged ? DeviceState::kGone : DeviceState::kSilent;
  if (delivered && !unplugged) {
    next_attempt_ = calls_.now();
  } else {
    next_attempt_ = calls_.now() + kBetweenAttempts;
  }
}

void V4l2Camera::note_silence() {
  const nanoseconds longest(std::llround(kSilentPeriods * 1e9 / config_.rate_hz));
  if (state_ == DeviceState::kStreaming && calls_.now() - last_sign_of_life_ > longest) {
    state_ = DeviceState::kSilent;
  }
}

void V4l2Camera::recycle(std::vector<std::uint8_t> bytes) {
  const std::lock_guard lock(spare_mutex_);
  if (spare_.size() < kMostWaiting) spare_.push_back(std::move(bytes));
}

std::vector<std::uint8_t> V4l2Camera::spare_bytes() {
  const std::lock_guard lock(spare_mutex_);
  if (spare_.empty()) return {};
  std::vector<std::uint8_t> bytes = std::move(spare_.back());
  spare_.pop_back();
  return bytes;
}

}  // namespace sparsight
