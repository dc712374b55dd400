#pragma once

namespace sparsight {

// How often the image in which a place is recognised is halved: as configured, but not so often
// that few corners are left to know it by.
constexpr int place_image_level(int configured, int width) {
  constexpr int kFewestColumns = 300;
  int level = configured;
  while (level > 0 && (width >> level) < kFewestColumns) --level;
  return level;
}

}  // namespace sparsight
