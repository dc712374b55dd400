#include "drivers/vlp16/sensor_web_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>

namespace sparsight {
namespace {

using Json = nlohmann::json;

Result<Json> object_of(const std::string& text, const std::string& source) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: the answer is no JSON object; is it a VLP-16 that answers there?",
                            source));
  }
  return json;
}

const Json* find(const Json& json, std::initializer_list<const char*> path) {
  const Json* at = &json;
  for (const char* const key : path) {
    if (!at->is_object()) return nullptr;
    const auto found = at->find(key);
    if (found == at->end()) return nullptr;
    at = &*found;
  }
  return at;
}

std::optional<std::string> text_at(const Json& json, std::initializer_list<const char*> path) {
  const Json* const value = find(json, path);
  if (value == nullptr || !value->is_string()) return std::nullopt;
  return value->get<std::string>();
}

std::optional<double> number_at(const Json& json, std::initializer_list<const char*> path) {
  const Json* const value = find(json, path);
  if (value == nullptr) return std::nullopt;
  if (value->is_number()) return value->get<double>();
  if (!value->is_string()) return std::nullopt;
  const auto text = value->get<std::string>();
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (parsed.ec != std::errc{} || parsed.ptr != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<int> integer_at(const Json& json, std::initializer_list<const char*> path) {
  constexpr double kLimit = 1e6;  // beyond everything a sensor counts
  const auto number = number_at(json, path);
  if (!number || std::abs(*number) > kLimit) return std::nullopt;
  return static_cast<int>(std::lround(*number));
}

std::optional<std::string> word_at(const Json& json, std::initializer_list<const char*> path) {
  auto text = text_at(json, path);
  if (!text) return std::nullopt;
  for (char& c : *text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// "On" in the status, "on" in the settings.
std::optional<bool> switch_at(const Json& json, std::initializer_list<const char*> path) {
  const Json* const value = find(json, path);
  if (value != nullptr && value->is_boolean()) return value->get<bool>();
  const auto word = word_at(json, path);
  if (word == "on") return true;
  if (word == "off") return false;
  return std::nullopt;
}

std::optional<ReturnMode> return_mode_at(const Json& json,
                                         std::initializer_list<const char*> path) {
  const auto word = word_at(json, path);
  if (word == "strongest") return ReturnMode::kStrongest;
  if (word == "last") return ReturnMode::kLast;
  if (word == "dual") return ReturnMode::kDual;
  return std::nullopt;
}

std::optional<PpsState> pps_at(const Json& json, std::initializer_list<const char*> path) {
  const auto word = word_at(json, path);
  if (word == "absent") return PpsState::kAbsent;
  if (word == "synchronizing") return PpsState::kSynchronizing;
  if (word == "locked") return PpsState::kLocked;
  if (word == "error") return PpsState::kError;
  return std::nullopt;
}

// A 12-bit converter with a reference of 5 V.
std::optional<double> voltage_at(const Json& json, std::initializer_list<const char*> path) {
  const auto raw = number_at(json, path);
  if (!raw || *raw < 0.0 || *raw > 4095.0) return std::nullopt;
  return *raw * 5.0 / 4096.0;
}

// LM20 data sheet, SNIS106, eq. (1), solved for the temperature.
std::optional<double> temperature_at(const Json& json, std::initializer_list<const char*> path) {
  const auto voltage = voltage_at(json, path);
  if (!voltage) return std::nullopt;
  const double under_root = 2.1962e6 + (1.8639 - *voltage) / 3.88e-6;
  if (under_root < 0.0) return std::nullopt;
  return -1481.96 + std::sqrt(under_root);
}

}  // namespace

Result<SensorSettings> parse_sensor_settings(const std::string& text, const std::string& source) {
  const auto json = object_of(text, source);
  if (!json) return tl::make_unexpected(json.error());
  SensorSettings settings;
  settings.rpm = integer_at(*json, {"rpm"});
  settings.return_mode = return_mode_at(*json, {"returns"});
  settings.laser_on = switch_at(*json, {"laser"});
  settings.phase_lock = switch_at(*json, {"phaselock", "enabled"});
  settings.phase_lock_centideg = integer_at(*json, {"phaselock", "offset"});
  settings.view_start_deg = integer_at(*json, {"fov", "start"});
  settings.view_end_deg = integer_at(*json, {"fov", "end"});
  return settings;
}

Result<SensorStatus> parse_sensor_status(const std::string& text, const std::string& source) {
  const auto json = object_of(text, source);
  if (!json) return tl::make_unexpected(json.error());
  SensorStatus status;
  status.pps = pps_at(*json, {"gps", "pps_state"});
  status.gps_position = text_at(*json, {"gps", "position"}).value_or("");
  status.motor_on = switch_at(*json, {"motor", "state"});
  status.motor_rpm = integer_at(*json, {"motor", "rpm"});
  status.laser_on = switch_at(*json, {"laser", "state"});
  return status;
}

Result<SensorDiagnostics> parse_sensor_diagnostics(const std::string& text,
                                                   const std::string& source) {
  const auto json = object_of(text, source);
  if (!json) return tl::make_unexpected(json.error());
  SensorDiagnostics diagnostics;
  diagnostics.top_temperature_c = temperature_at(*json, {"volt_temp", "top", "lm20_temp"});
  diagnostics.bottom_temperature_c = temperature_at(*json, {"volt_temp", "bot", "lm20_temp"});
  if (const auto voltage = voltage_at(*json, {"volt_temp", "bot", "i_out"})) {
    diagnostics.current_a = 10.0 * (*voltage - 2.5);
  }
  return diagnostics;
}

}  // namespace sparsight
