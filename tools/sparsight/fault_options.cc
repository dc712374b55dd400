#include "tools/sparsight/fault_options.h"

#include <cstdio>
#include <map>
#include <optional>
#include <utility>

namespace sparsight {
namespace {

const std::map<std::string, DeviceKind> kDevices{{"camera", DeviceKind::kCamera},
                                                 {"lidar", DeviceKind::kLidar},
                                                 {"trigger", DeviceKind::kTrigger}};

// FIRST:SECOND, seconds, of which the second is at least `least`.
std::optional<std::pair<double, double>> read_pair(const std::string& text, double least) {
  double first = 0.0;
  double second = 0.0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%c", &first, &second, &rest) != 2) return std::nullopt;
  if (!(first >= 0.0 && first < 1e5 && second >= least && second < 1e5)) return std::nullopt;
  return std::pair{first, second};
}

}  // namespace

std::chrono::nanoseconds seconds_given(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

bool read_away(const std::string& text, SimulatedFaults& faults) {
  const std::size_t colon = text.find(':');
  const auto device = kDevices.find(text.substr(0, colon));
  if (colon == std::string::npos || device == kDevices.end()) return false;
  double from = 0.0;
  double lasting = 0.0;
  char rest = 0;
  if (std::sscanf(text.c_str() + colon, ":%lf:%lf%c", &from, &lasting, &rest) != 2) return false;
  if (!(from >= 0.0 && lasting > 0.0 && from < 1e5 && lasting < 1e5)) return false;
  faults.away.push_back({device->second, seconds_given(from), seconds_given(lasting)});
  return true;
}

std::string away_usage(const std::string& text) {
  return "--away is camera|lidar|trigger:FROM:SECONDS, as in camera:10:3, not " + text;
}

bool read_cover(const std::string& text, SimulatedFaults& faults) {
  const auto times = read_pair(text, 0.0);
  if (times) faults.covered.push_back({seconds_given(times->first), seconds_given(times->second)});
  return times.has_value();
}

std::string cover_usage(const std::string& text) {
  return "--cover is FROM:SECONDS, as in 10:5, not " + text;
}

bool read_carry(const std::string& text, SimulatedFaults& faults) {
  const auto times = read_pair(text, -1e5);
  if (times) faults.carried.push_back({seconds_given(times->first), seconds_given(times->second)});
  return times.has_value();
}

std::string carry_usage(const std::string& text) {
  return "--carry is AT:AHEAD, as in 20:8 or 20:-8, not " + text;
}

}  // namespace sparsight
