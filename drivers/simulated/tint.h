#pragma once

#include <Eigen/Core>

namespace sparsight::simulated {

// What a colour camera sees more and less of than a grey one: factors of red, green and blue whose
// luma is one, so that in grey nothing changes. Hue in degrees (0 red, 120 green, 240 blue);
// saturation 0 is grey, 1 a strong colour.
Eigen::Vector3f tint(float hue_deg, float saturation);

// Which of the three a pixel of the Bayer pattern RGGB has: 0 red, 1 green, 2 blue.
constexpr int bayer_channel(int u, int v) { return (u & 1) + (v & 1); }

}  // namespace sparsight::simulated
