#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tools/graph/g2o_file.h"

// Any bytes are a graph or an error; a graph can be written and read back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto file = sparsight::parse_g2o(text, "fuzz.g2o");
  if (!file) {
    return 0;
  }
  const auto again = sparsight::parse_g2o(sparsight::format_g2o(*file, {}), "again.g2o");
  if (!again || again->graph.edges.size() != file->graph.edges.size()) {
    std::abort();
  }
  return 0;
}
