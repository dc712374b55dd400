#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tools/loop/vocabulary_file.h"

// Any bytes are a vocabulary or an error; a vocabulary knows a word for everything, and is written
// and read back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto vocabulary = sparsight::parse_vocabulary(bytes, "fuzz");
  if (!vocabulary) {
    return 0;
  }
  if (vocabulary->word_of({}) >= vocabulary->words() ||
      !sparsight::parse_vocabulary(vocabulary->to_bytes(), "again")) {
    std::abort();
  }
  return 0;
}
