#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/datasets/frame_times.h"
#include "drivers/datasets/trigger_time.h"

// Any text is read or refused; what is read can be taken for images and for their triggers.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto stamps = sparsight::parse_timestamps_utc(text, "timestamps.txt");
  if (!stamps) return 0;
  std::vector<sparsight::HostTime> arrivals;
  for (const auto& stamp : *stamps) {
    if (stamp) arrivals.push_back(*stamp);
  }
  const std::size_t images = arrivals.size();
  if (sparsight::exposure_times(std::move(arrivals), *stamps).size() != images) __builtin_trap();
  return 0;
}
