#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tools/configuration/rig_file.h"

// Any text is a rig or an error with a message; a rig is described, and read back the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto rig = sparsight::parse_rig(text, "rig.toml");
  if (!rig) {
    if (rig.error().message.empty()) __builtin_trap();
    return 0;
  }
  const std::string toml = sparsight::describe(*rig);
  const auto again = sparsight::parse_rig(toml, "described.toml");
  if (!again || sparsight::describe(*again) != toml) __builtin_trap();
  return 0;
}
