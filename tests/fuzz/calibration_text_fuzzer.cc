#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/datasets/calibration_text.h"

// Any text is read or refused; what is read keeps the promises of the header.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto calibration = sparsight::CalibrationText::parse(text, "calib.txt");
  if (!calibration) return 0;
  const auto camera = sparsight::rectified_camera(*calibration, "P0");
  if (camera && !(camera->intrinsics.fx > 0)) __builtin_trap();
  const auto T = calibration->transform("Tr");
  if (T && !(T->linear() * T->linear().transpose()).isIdentity(1e-9)) __builtin_trap();
  calibration->rotation("R");
  return 0;
}
