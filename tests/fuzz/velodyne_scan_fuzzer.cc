#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/datasets/firing_time.h"
#include "drivers/datasets/rings.h"
#include "drivers/datasets/velodyne_scan.h"

// Any bytes are read or refused; whatever is read can be put into rings, thinned out and timed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  sparsight::parse_velodyne_text(bytes, "0.txt");
  auto scan = sparsight::parse_velodyne_scan(bytes, "0.bin");
  if (!scan) return 0;
  const std::size_t points = scan->returns.size();
  if (points + scan->refused > size / 16) __builtin_trap();
  const std::size_t rings = sparsight::assign_rings(scan->returns);
  if (scan->returns.size() != points) __builtin_trap();
  sparsight::keep_rings(scan->returns, rings, 3);
  using namespace std::chrono_literals;
  sparsight::stamp_returns(scan->returns, {sparsight::HostTime(0s), sparsight::HostTime(100ms)},
                           sparsight::HostTime(50ms));
  for (const sparsight::LidarReturn& point : scan->returns) {
    if (point.from_exposure_ns < -50'000'000 || point.from_exposure_ns > 50'000'000) {
      __builtin_trap();
    }
  }
  return 0;
}
