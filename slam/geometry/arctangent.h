#pragma once

#include <algorithm>
#include <cmath>

namespace sparsight {

// atan2 within 3e-7 of a radian, for those who ask for each return of a sweep: the library's is
// exact and takes several times as long. Without a direction, as of (0, 0) or of infinities, 0.
// Polynomial: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.49. Real-time-safe.
inline float arctangent(float y, float x) {
  const float across = std::abs(y);
  const float along = std::abs(x);
  const float longer = std::max(along, across);
  if (!(longer > 0.0F) || std::isinf(longer)) return 0.0F;
  const float z = std::min(along, across) / longer;
  const float z2 = z * z;
  float p = 0.0028662257F;
  p = p * z2 - 0.0161657367F;
  p = p * z2 + 0.0429096138F;
  p = p * z2 - 0.0752896400F;
  p = p * z2 + 0.1065626393F;
  p = p * z2 - 0.1420889944F;
  p = p * z2 + 0.1999355085F;
  p = p * z2 - 0.3333314528F;
  float angle = z + z * z2 * p;
  if (across > along) angle = static_cast<float>(M_PI_2) - angle;
  if (x < 0.0F) angle = static_cast<float>(M_PI) - angle;
  return std::copysign(angle, y);
}

}  // namespace sparsight
