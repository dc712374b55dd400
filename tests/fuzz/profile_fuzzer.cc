#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tools/configuration/profile.h"

// Any text is a profile or an error with a message; a profile is described, and read back the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto profile = sparsight::parse_profile(text, "profile.toml");
  if (!profile) {
    if (profile.error().message.empty()) __builtin_trap();
    return 0;
  }
  const std::string toml = sparsight::describe_profile(*profile);
  const auto again = sparsight::parse_profile(toml, "described.toml");
  if (!again || sparsight::describe_profile(*again) != toml) __builtin_trap();
  return 0;
}
