#include "drivers/datasets/trigger_time.h"

#include <algorithm>
#include <chrono>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

// Exposure, read-out and transfer of one image. Longer or negative: the cameras were not triggered
// by the scanner, and their own stamps are all there is.
constexpr nanoseconds kMaxDelay = std::chrono::milliseconds(30);
// A trigger that disagrees with the usual delay by more than this belongs to another turn.
constexpr nanoseconds kMaxDelayJitter = std::chrono::milliseconds(10);

std::optional<nanoseconds> usual_delay(const std::vector<HostTime>& arrivals,
                                       const std::vector<std::optional<HostTime>>& triggers) {
  std::vector<nanoseconds> delays;
  for (std::size_t i = 0; i < std::min(arrivals.size(), triggers.size()); ++i) {
    if (triggers[i]) delays.push_back(arrivals[i] - *triggers[i]);
  }
  if (delays.empty()) return std::nullopt;
  const auto middle = delays.begin() + static_cast<std::ptrdiff_t>(delays.size() / 2);
  std::nth_element(delays.begin(), middle, delays.end());
  if (*middle < nanoseconds::zero() || *middle > kMaxDelay) return std::nullopt;
  return *middle;
}

}  // namespace

std::vector<HostTime> exposure_times(std::vector<HostTime> arrivals,
                                     const std::vector<std::optional<HostTime>>& triggers) {
  const std::optional<nanoseconds> delay = usual_delay(arrivals, triggers);
  if (!delay) return arrivals;
  std::vector<HostTime> exposures;
  exposures.reserve(arrivals.size());
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    HostTime exposure = arrivals[i] - *delay;
    if (i < triggers.size() && triggers[i]) {
      const nanoseconds jitter = std::chrono::abs(*triggers[i] - exposure);
      if (jitter < kMaxDelayJitter) exposure = *triggers[i];
    }
    exposures.push_back(exposure);
  }
  return exposures;
}

}  // namespace sparsight
