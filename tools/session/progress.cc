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

std::string progress_text(const ProgressFigures& figures, const char* status) {
  const double wall_s = std::max(1e-3, figures.wall_s);
  const auto frames = static_cast<double>(figures.frames);
  const double rate = frames / wall_s;
  const std::string speed =
      fmt::format("{:.1f} frames/s  {:.1f} x real time", rate, figures.recorded_s / wall_s);
  if (!figures.total_frames || *figures.total_frames == 0) {
    return fmt::format("frame {}  {}  {}", figures.frames, speed, status);
  }
  const auto total = static_cast<double>(*figures.total_frames);
  return fmt::format("frame {}/{}  {:.0f} %  {}  {} left  {}", figures.frames,
                     *figures.total_frames, 100.0 * frames / total, speed,
                     minutes_and_seconds(std::max(0.0, total - frames) / rate), status);
}

Progress::Style Progress::style_for(std::FILE* stream, bool quiet) {
  if (quiet) return Style::kQuiet;
  return isatty(fileno(stream)) != 0 ? Style::kTerminal : Style::kPlain;
}

Progress::Progress(std::FILE* stream, Style style, std::optional<std::size_t> total_frames)
    : stream_(stream), style_(style), start_(Clock::now()), last_shown_(start_) {
  figures_.total_frames = total_frames;
}

void Progress::frame(HostTime exposure, const char* status) {
  if (!first_exposure_) first_exposure_ = exposure;
  ++figures_.frames;
  const std::chrono::milliseconds interval(style_ == Style::kTerminal ? 100 : 5000);
  const auto now = Clock::now();
  if (style_ == Style::kQuiet || now - last_shown_ < interval) return;
  last_shown_ = now;
  figures_.wall_s = to_seconds(now - start_);
  figures_.recorded_s = to_seconds(exposure - *first_exposure_);
  if (style_ == Style::kTerminal) {
    // Return to the line's start, write, clear what an older, longer text left.
    fmt::print(stream_, "\r{}\x1b[K", progress_text(figures_, status));
    line_open_ = true;
  } else {
    fmt::print(stream_, "{}\n", progress_text(figures_, status));
  }
  std::fflush(stream_);
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
