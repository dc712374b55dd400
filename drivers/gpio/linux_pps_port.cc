#include "drivers/gpio/linux_pps_port.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gpiod.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <system_error>

namespace sparsight {
namespace {

tl::unexpected<Error> system_failure(const std::string& what) {
  return fail(ErrorCode::kUnreadable,
              fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

// 9600 baud, eight bits, no parity, one stop bit, nothing translated.
bool make_raw_9600(int fd) {
  termios settings{};
  if (::tcgetattr(fd, &settings) < 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag = CS8 | CLOCAL | CREAD;
  ::cfsetispeed(&settings, B9600);
  ::cfsetospeed(&settings, B9600);
  return ::tcsetattr(fd, TCSANOW, &settings) == 0;
}

class LinuxPpsPort final : public PpsPort {
 public:
  ~LinuxPpsPort() override { close(); }

  Result<void> open(const TriggerConfig& config) override {
    auto opened = open_pin(config);
    if (opened && !config.nmea_device.empty()) opened = open_serial(config.nmea_device);
    if (!opened) close();
    return opened;
  }

  void close() override {
    if (chip_) {
      set_pin(false);
      gpiod_chip_close(chip_);  // and with it the line
    }
    if (serial_ >= 0) ::close(serial_);
    chip_ = nullptr;
    line_ = nullptr;
    serial_ = -1;
  }

  bool set_pin(bool high) override {
    return line_ && gpiod_line_set_value(line_, high ? 1 : 0) == 0;
  }

  bool send(std::string_view sentence) override {
    return ::write(serial_, sentence.data(), sentence.size()) ==
           static_cast<ssize_t>(sentence.size());
  }

  void sleep_until(HostTime time) override {
    const auto since = time.time_since_epoch();
    const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
    const timespec until{seconds.count(), (since - seconds).count()};
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
  }

  HostTime now() override { return HostClock::now(); }
  std::chrono::sys_time<std::chrono::nanoseconds> utc_now() override {
    return std::chrono::system_clock::now();
  }

 private:
  Result<void> open_pin(const TriggerConfig& config) {
    chip_ = gpiod_chip_open(config.chip.c_str());
    if (!chip_) return system_failure(config.chip + ": cannot open the GPIO chip");
    line_ = gpiod_chip_get_line(chip_, config.pps_output_line.value_or(0));
    if (!line_ || gpiod_line_request_output(line_, "sparsight", 0) < 0) {
      return system_failure(fmt::format("{}: cannot drive line {} ([trigger] pps_output_line)",
                                        config.chip, config.pps_output_line.value_or(0)));
    }
    return {};
  }

  Result<void> open_serial(const std::string& device) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's signature
    serial_ = ::open(device.c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (serial_ < 0 || !make_raw_9600(serial_)) {
      return system_failure(device + ": cannot use it as a serial port ([trigger] nmea_device)");
    }
    return {};
  }

  gpiod_chip* chip_ = nullptr;
  gpiod_line* line_ = nullptr;
  int serial_ = -1;
};

}  // namespace

std::unique_ptr<PpsPort> linux_pps_port() { return std::make_unique<LinuxPpsPort>(); }

}  // namespace sparsight
