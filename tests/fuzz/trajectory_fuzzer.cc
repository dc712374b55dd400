#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "tools/evaluation/evaluation.h"

// Any bytes are a trajectory or an error; what is a trajectory can be evaluated and written.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes as text
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto times = sparsight::parse_times(text, "times");
  const auto trajectory = sparsight::parse_trajectory(text, "poses");
  if (!trajectory) {
    return 0;
  }
  const sparsight::EvaluationOptions options{.segments = {.lengths_m = {1, 10}, .step_frames = 3}};
  if (!sparsight::evaluate_trajectories(*trajectory, *trajectory, options)) {
    std::abort();  // a trajectory always pairs with itself
  }
  const std::string kitti = sparsight::format_kitti(trajectory->poses);
  if (!sparsight::parse_trajectory(kitti, "again")) {
    std::abort();
  }
  return 0;
}
