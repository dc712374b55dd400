#include "realtime/executor/loop_clock.h"

#include <cerrno>
#include <ctime>

namespace sparsight {

void MonotonicClock::sleep_until(HostTime time) noexcept {
  const auto since = time.time_since_epoch();
  if (since <= std::chrono::nanoseconds(0)) return;
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
  const timespec until{.tv_sec = static_cast<std::time_t>(seconds.count()),
                       .tv_nsec = static_cast<long>((since - seconds).count())};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace sparsight
