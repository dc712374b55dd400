#include "drivers/vlp16/sensor_settings.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <thread>

namespace sparsight {
namespace {

constexpr int kMinRpm = 300;
constexpr int kMaxRpm = 1200;
constexpr int kRpmStep = 60;  // otherwise neither speed control nor phase lock work (manual p. 50)

const char* name_of(ReturnMode mode) {
  switch (mode) {
    case ReturnMode::kStrongest:
      return "Strongest";
    case ReturnMode::kLast:
      return "Last";
    case ReturnMode::kDual:
      break;
  }
  return "Dual";
}

// One thing to be set: where, and how to see that it is.
struct Setting {
  std::string path;
  std::string form;
  std::function<bool(const SensorSettings&)> holds;
};

// Degrees sent as they are would lock a hundred times off, without a word.
int centideg_of(double degrees) { return static_cast<int>(std::lround(degrees * 100.0)) % 36000; }

std::vector<Setting> settings_of(const LidarConfig& config) {
  std::vector<Setting> settings;
  if (config.rpm) {
    settings.push_back({"/cgi/setting", fmt::format("rpm={}", *config.rpm),
                        [rpm = *config.rpm](const SensorSettings& s) { return s.rpm == rpm; }});
  }
  if (config.return_mode) {
    settings.push_back(
        {"/cgi/setting", fmt::format("returns={}", name_of(*config.return_mode)),
         [mode = *config.return_mode](const SensorSettings& s) { return s.return_mode == mode; }});
  }
  if (config.phase_lock_deg) {
    const int offset = centideg_of(*config.phase_lock_deg);
    settings.push_back({"/cgi/setting/phaselock", fmt::format("enabled=on&offset={}", offset),
                        [offset](const SensorSettings& s) {
                          return s.phase_lock == true && s.phase_lock_centideg == offset;
                        }});
  }
  return settings;
}

Result<void> apply(const Setting& setting, const SensorWeb& web, const ReadBack& read_back) {
  if (auto posted = web.post(setting.path, setting.form); !posted) return posted;
  for (int attempt = 0; attempt < read_back.attempts; ++attempt) {
    std::this_thread::sleep_for(read_back.pause);
    const auto now = web.settings();
    if (!now) return tl::make_unexpected(now.error());
    if (setting.holds(*now)) return {};
  }
  return fail(ErrorCode::kOutOfRange,
              fmt::format("the LiDAR did not take \"{}\": it accepted the request ({}), but its "
                          "settings do not show it; its firmware may not know the setting",
                          setting.form, setting.path));
}

}  // namespace

Result<void> check_sensor_settings(const LidarConfig& config) {
  if (config.rpm &&
      (*config.rpm < kMinRpm || *config.rpm > kMaxRpm || *config.rpm % kRpmStep != 0)) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("lidar.rpm: {} is not a multiple of {} from {} to {}", *config.rpm,
                            kRpmStep, kMinRpm, kMaxRpm));
  }
  if (config.phase_lock_deg && !(*config.phase_lock_deg >= 0.0 && *config.phase_lock_deg < 360.0)) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("lidar.phase_lock_deg: {} is not within [0, 360)", *config.phase_lock_deg));
  }
  return {};
}

Result<std::vector<std::string>> apply_sensor_settings(const LidarConfig& config,
                                                       const SensorWeb& web,
                                                       const ReadBack& read_back) {
  if (auto checked = check_sensor_settings(config); !checked) {
    return tl::make_unexpected(checked.error());
  }
  const std::vector<Setting> settings = settings_of(config);
  std::vector<std::string> changed;
  if (settings.empty()) return changed;  // a sensor that is to be left alone is not even asked
  const auto before = web.settings();
  if (!before) return tl::make_unexpected(before.error());
  for (const Setting& setting : settings) {
    if (setting.holds(*before)) continue;
    if (auto applied = apply(setting, web, read_back); !applied) {
      return tl::make_unexpected(applied.error());
    }
    changed.push_back(setting.form);
  }
  return changed;
}

}  // namespace sparsight
