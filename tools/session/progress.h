#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>

#include "hal/time.h"

namespace sparsight {

struct ProgressFigures {
  std::size_t frames = 0;
  std::optional<std::size_t> total_frames;
  double wall_s = 0.0;
  double recorded_s = 0.0;
};

std::string progress_text(const ProgressFigures& figures, const char* status);

// Progress of a replay for a person: one line that is rewritten on a terminal, now and then a line
// elsewhere, nothing if quiet. Thread-bound.
class Progress {
 public:
  enum class Style : std::uint8_t { kTerminal, kPlain, kQuiet };
  // How `stream` is to be written to.
  static Style style_for(std::FILE* stream, bool quiet);

  Progress(std::FILE* stream, Style style, std::optional<std::size_t> total_frames);

  void frame(HostTime exposure, const char* status);
  // A line that stays, without tearing the progress line.
  void say(const std::string& line);
  // Ends the rewritten line.
  void end();

 private:
  std::FILE* stream_;
  Style style_;
  ProgressFigures figures_;
  std::optional<HostTime> first_exposure_;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_shown_;
  bool line_open_ = false;
};

}  // namespace sparsight
