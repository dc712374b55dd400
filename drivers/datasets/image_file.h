#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hal/image.h"
#include "hal/result.h"

namespace sparsight {

struct DecodedImage {
  GreyImage grey;
  std::optional<ColorImage> color;  // none: the camera is grey
};

// A PNG or JPEG file's bytes. 16-bit grey keeps its upper 8 bits; colour becomes grey by the luma
// of ITU-R BT.601. `file` is for error messages.
Result<DecodedImage> decode_image(std::string_view bytes, const std::string& file);

}  // namespace sparsight
