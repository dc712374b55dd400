#include "tools/sparsight/fault_options.h"

#include <cstdio>
#include <map>

namespace sparsight {
namespace {

const std::map<std::string, DeviceKind> kDevices{{"camera", DeviceKind::kCamera},
                                                 {"lidar", DeviceKind::kLidar},
                                                 {"trigger", DeviceKind::kTrigger}};

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

}  // namespace sparsight
