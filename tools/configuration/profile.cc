#include "tools/configuration/profile.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <sstream>

#include "tools/configuration/embedded_profiles.h"
#include "tools/configuration/odometry_fields.h"
#include "tools/configuration/toml_file.h"

namespace sparsight {
std::vector<std::string> built_in_profiles() {
  std::vector<std::string> names;
  for (const EmbeddedProfile& profile : embedded_profiles()) names.emplace_back(profile.name);
  return names;
}

Result<OdometryConfig> parse_profile(std::string_view toml, std::string_view file) {
  return parse_toml<OdometryConfig>(toml, file);
}

Result<OdometryConfig> load_profile(const std::string& name_or_path) {
  for (const EmbeddedProfile& profile : embedded_profiles()) {
    if (profile.name == name_or_path) {
      return parse_profile(profile.toml, fmt::format("config/{}.toml", profile.name));
    }
  }
  std::ifstream file(name_or_path);
  std::ostringstream toml;
  if (!file || !(toml << file.rdbuf())) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot read this profile; give one of {} or the path of a "
                            "TOML file that is not empty",
                            name_or_path, fmt::join(built_in_profiles(), ", ")));
  }
  return parse_profile(toml.str(), name_or_path);
}

std::string describe_profile(const OdometryConfig& config) { return describe_as_toml(config); }

}  // namespace sparsight
