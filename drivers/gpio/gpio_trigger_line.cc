#include "drivers/gpio/gpio_trigger_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

// An edge stamped first on one line may be queued after one of the other line: by so much at most,
// the threads of the two interrupts being real-time ones.
constexpr nanoseconds kSettling = std::chrono::milliseconds(1);
constexpr nanoseconds kSilence = std::chrono::seconds(1);
constexpr nanoseconds kBetweenAttempts = std::chrono::milliseconds(200);

std::string_view remedy(int error_number) {
  switch (error_number) {
    case ENOENT:
    case ENODEV:
      return "; gpiodetect lists the chips there are";
    case EINVAL:
      return "; the chip has no such line, or none that can interrupt: gpioinfo lists them";
    case EBUSY:
      return "; another program or driver has the line: gpioinfo says which";
    case EACCES:
    case EPERM:
      return "; the user must belong to the group that owns the chip's device, gpio by our udev "
             "rule";
    default:
      return "";
  }
}

std::string_view name_of(EdgeLine line) {
  return line == EdgeLine::kExposure ? "exposure_line" : "pps_line";
}

}  // namespace

GpioTriggerLine::GpioTriggerLine(TriggerConfig config, GpioCalls& calls)
    : config_(std::move(config)), calls_(calls) {}

Result<void> GpioTriggerLine::start() {
  if (state_ != DeviceState::kStopped) return {};
  return watch_lines();
}

void GpioTriggerLine::stop() {
  lines_.clear();
  handles_.clear();
  state_ = DeviceState::kStopped;
}

Result<void> GpioTriggerLine::watch_lines() {
  // Of a short trigger pulse the kernel reads the level too late to tell its edges apart.
  const auto edges = config_.exposure_active ? WatchedEdges::kBoth : WatchedEdges::kRising;
  auto watched = watch(EdgeLine::kExposure, config_.exposure_line, edges, config_.active_low);
  if (watched && config_.pps_line) {
    watched = watch(EdgeLine::kPps, *config_.pps_line, WatchedEdges::kRising, false);
  }
  if (!watched) {
    lines_.clear();
    handles_.clear();
    return watched;
  }
  last_sign_of_life_ = calls_.now();
  state_ = DeviceState::kStreaming;
  return {};
}

Result<void> GpioTriggerLine::watch(EdgeLine line, unsigned offset, WatchedEdges edges,
                                    bool active_low) {
  const int handle = calls_.watch(config_.chip, offset, edges, active_low);
  if (handle < 0) {
    const ErrorCode code =
        handle == -ENOENT || handle == -ENODEV ? ErrorCode::kNotFound : ErrorCode::kUnreadable;
    return fail(code, fmt::format("{}: cannot watch line {} ([trigger] {}): {}{}", config_.chip,
                                  offset, name_of(line), std::generic_category().message(-handle),
                                  remedy(-handle)));
  }
  lines_.push_back(std::make_unique<WatchedLine>(calls_, handle, line, edges));
  handles_.push_back(handle);
  return {};
}

std::optional<Edge> GpioTriggerLine::read(nanoseconds patience) {
  if (state_ == DeviceState::kStopped) return std::nullopt;
  const HostTime deadline = calls_.now() + patience;
  for (;;) {
    // Even with edges at hand: the kernel's queue is short.
    if (!lines_.empty() && !drain_all()) continue;
    if (auto edge = first_edge()) return edge;
    const nanoseconds left = deadline - calls_.now();
    if (left <= nanoseconds(0)) break;
    advance(left);
  }
  if (state_ == DeviceState::kStreaming && calls_.now() - last_sign_of_life_ > kSilence) {
    state_ = DeviceState::kSilent;
  }
  return std::nullopt;
}

void GpioTriggerLine::advance(nanoseconds patience) {
  if (lines_.empty()) return look_for_lines(patience);
  if (const nanoseconds wait = unsettled(); wait > nanoseconds(0)) {
    return calls_.sleep(std::min(wait, patience));
  }
  if (const int ready = calls_.wait(handles_, patience); ready < 0) lose_lines(ready);
}

void GpioTriggerLine::look_for_lines(nanoseconds patience) {
  const HostTime now = calls_.now();
  if (now < next_attempt_) return calls_.sleep(std::min(patience, next_attempt_ - now));
  next_attempt_ = now + kBetweenAttempts;
  if (auto watched = watch_lines(); !watched) last_fault_ = watched.error().message;
}

// False, and no lines any more, if one of them failed.
bool GpioTriggerLine::drain_all() {
  for (const auto& line : lines_) {
    if (const int status = line->drain(counters_); status < 0) {
      lose_lines(status);
      return false;
    }
  }
  return true;
}

void GpioTriggerLine::lose_lines(int negative_errno) {
  last_fault_ =
      fmt::format("{}: {}{}", config_.chip, std::generic_category().message(-negative_errno),
                  remedy(-negative_errno));
  stop();
  state_ = DeviceState::kGone;
  next_attempt_ = calls_.now() + kBetweenAttempts;
}

WatchedLine* GpioTriggerLine::line_with_first_edge() const {
  WatchedLine* first = nullptr;
  for (const auto& line : lines_) {
    if (!line->empty() && (!first || line->first_time() < first->first_time())) first = line.get();
  }
  return first;
}

// How long the other line may still come up with an edge before the first one at hand.
nanoseconds GpioTriggerLine::unsettled() const {
  const WatchedLine* first = line_with_first_edge();
  if (!first) return nanoseconds(0);
  const bool all_known =
      std::all_of(lines_.begin(), lines_.end(), [](const auto& line) { return !line->empty(); });
  return all_known ? nanoseconds(0) : first->first_time() + kSettling - calls_.now();
}

std::optional<Edge> GpioTriggerLine::first_edge() {
  for (;;) {
    WatchedLine* line = line_with_first_edge();
    if (!line || unsettled() > nanoseconds(0)) return std::nullopt;
    const HostTime now = calls_.now();
    // Before Linux 5.7 the kernel stamped edges with the time of day.
    const bool other_clock = line->first_time() > now;
    const bool too_late = line->first_time() < last_edge_;
    const Edge edge = line->take_first(counters_);
    if (!other_clock && !too_late) {
      last_edge_ = edge.time;
      last_sign_of_life_ = now;
      state_ = DeviceState::kStreaming;
      return edge;
    }
    --counters_.edges;
    last_fault_ =
        fmt::format("{}: an edge was left out: {}", config_.chip,
                    other_clock ? "its time is not on CLOCK_MONOTONIC; Linux 5.7 or newer is needed"
                                : "it came after a later one of the other line");
  }
}

}  // namespace sparsight
