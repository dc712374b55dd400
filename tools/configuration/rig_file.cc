#include "tools/configuration/rig_file.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "tools/configuration/rig_fields.h"
#include "tools/configuration/toml_file.h"

namespace sparsight {

Result<RigConfig> load_rig(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream toml;
  if (!file || !(toml << file.rdbuf())) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: cannot read this rig file; give the path of a TOML file such as "
                            "config/rig/handheld.toml",
                            path));
  }
  return parse_rig(toml.str(), path);
}

Result<RigConfig> parse_rig(std::string_view toml, std::string_view file) {
  return parse_toml<RigConfig>(toml, file);
}

std::string describe(const RigConfig& rig) { return describe_as_toml(rig); }

}  // namespace sparsight
