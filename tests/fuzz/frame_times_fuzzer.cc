#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/datasets/frame_times.h"

// Any text is read or refused; times that are read can be compared and subtracted.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  auto times = sparsight::parse_times_seconds(text, "times.txt");
  if (!times) return 0;
  const auto increasing = sparsight::require_increasing(std::move(*times), "times.txt");
  if (increasing && increasing->size() > 1 &&
      (increasing->back() - increasing->front()).count() <= 0) {
    __builtin_trap();
  }
  return 0;
}
