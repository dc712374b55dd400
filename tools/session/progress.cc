#include "tools/session/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

using Clock = std::chrono::steady_clock;

std::string minutes_and_seconds(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Style Progress::style_for(std::FILE* stream, bool quiet) {
  if (quiet) return Style::kQuiet;
  return isatty(fileno(stream)) != 0 ? Style::kTerminal : Style::kPlain;
}

Progress::Progress(std::FILE* stream, Style style, std::optional<std::size_t> total_frames)
    : stream_(stream),
      style_(style),
      total_frames_(total_frames),
      start_(Clock::now()),
      last_shown_(start_) {}

void Progress::frame(HostTime exposure, const char* status) {
  if (!first_exposure_) first_exposure_ = exposure;
  last_exposure_ = exposure;
  ++frames_;
  const std::chrono::milliseconds interval(style_ == Style::kTerminal ? 100 : 5000);
  const auto now = Clock::now();
  if (style_ == Style::kQuiet || now - last_shown_ < interval) return;
  last_shown_ = now;
  if (style_ == Style::kTerminal) {
    // Return to the line's start, write, clear what an older, longer text left.
    fmt::print(stream_, "\r{}\x1b[K", line(now, status));
    line_open_ = true;
  } else {
    fmt::print(stream_, "{}\n", line(now, status));
  }
  std::fflush(stream_);
}

std::string Progress::line(Clock::time_point now, const char* status) const {
  const double wall_s = std::max(1e-3, to_seconds(now - start_));
  const double rate = static_cast<double>(frames_) / wall_s;
  const double realtime = to_seconds(last_exposure_ - *first_exposure_) / wall_s;
  if (!total_frames_ || *total_frames_ == 0) {
    return fmt::format("frame {}  {:.1f} frames/s  {:.1f} x real time  {}", frames_, rate, realtime,
                       status);
  }
  const std::size_t left = *total_frames_ - std::min(*total_frames_, frames_);
  return fmt::format("frame {}/{}  {:.0f} %  {:.1f} frames/s  {:.1f} x real time  {} left  {}",
                     frames_, *total_frames_,
                     100.0 * static_cast<double>(frames_) / static_cast<double>(*total_frames_),
                     rate, realtime, minutes_and_seconds(static_cast<double>(left) / rate), status);
}

void Progress::say(const std::string& text) {
  if (line_open_) fmt::print(stream_, "\r\x1b[K");
  line_open_ = false;
  fmt::print(stream_, "{}\n", text);
  std::fflush(stream_);
}

void Progress::end() {
  if (line_open_) fmt::print(stream_, "\r\x1b[K");
  line_open_ = false;
  std::fflush(stream_);
}

}  // namespace sparsight
