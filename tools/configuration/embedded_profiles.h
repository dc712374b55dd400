#pragma once

#include <span>
#include <string_view>

namespace sparsight {

struct EmbeddedProfile {
  std::string_view name;
  std::string_view toml;
};

// Copies of config/*.toml made when the program is built, so that it runs from anywhere.
std::span<const EmbeddedProfile> embedded_profiles();

}  // namespace sparsight
