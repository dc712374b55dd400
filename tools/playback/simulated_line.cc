#include "tools/playback/simulated_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

namespace sparsight {

Result<SimulatedLine> SimulatedLine::open(const std::string& chip, unsigned offset,
                                          const std::filesystem::path& sysfs) {
  const auto file =
      sysfs / std::filesystem::path(chip).filename() / fmt::format("sim_gpio{}", offset) / "pull";
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's signature
  const int fd = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (fd < 0) {
    return fail(
        ErrorCode::kNotFound,
        fmt::format("{}: {}; edges can be played to a chip of gpio-sim with this line only, "
                    "by root: docs/realtime.md says how one is made",
                    file.string(), std::generic_category().message(errno)));
  }
  SimulatedLine line(fd);
  line.pull(false);
  return line;
}

SimulatedLine::~SimulatedLine() {
  if (fd_ >= 0) ::close(fd_);
}

SimulatedLine::SimulatedLine(SimulatedLine&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), high_(other.high_) {}

int SimulatedLine::pull(bool high) {
  const std::string_view word = high ? "pull-up" : "pull-down";
  if (::pwrite(fd_, word.data(), word.size(), 0) < 0) return -errno;
  high_ = high;
  return 0;
}

}  // namespace sparsight
