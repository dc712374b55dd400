#include "drivers/simulated/imager.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "drivers/simulated/lens.h"
#include "drivers/simulated/random.h"

namespace sparsight::simulated {
namespace {

constexpr std::size_t kNoiseValues = 1U << 16U;
constexpr float kReadoutGrey2 = 1.0F;  // variance
constexpr float kShotGreyPerGrey = 0.018F;
constexpr float kShoulder = 205.0F;  // above, highlights are compressed instead of cut

float saturated(float grey) {
  if (grey <= kShoulder) return grey;
  return kShoulder +
         (255.0F - kShoulder) * (1.0F - std::exp((kShoulder - grey) / (255.0F - kShoulder)));
}

}  // namespace

Imager::Imager(const SimulationOptions& options, const CameraIntrinsics& camera, float gain)
    : options_(options), gain_(gain), noise_(kNoiseValues) {
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      // Between none and the cosine-fourth law of a simple lens: its fourth root.
      const double r2 = unproject(camera, {u, v}).squaredNorm();
      vignetting_.push_back(static_cast<float>(1.0 / std::sqrt(1.0 + r2)));
    }
  }
  Random random(options.seed, 0x401e);
  for (float& value : noise_) value = static_cast<float>(random.gaussian());
}

float Imager::brightness(std::uint64_t frame) const {
  if (options_.exposure_drift == 0.0) return 1.0F;
  const double t = static_cast<double>(frame) / options_.rate_hz;
  return static_cast<float>(1.0 + options_.exposure_drift * std::sin(2.0 * M_PI * t / 9.0) *
                                      std::cos(2.0 * M_PI * t / 23.0));
}

std::vector<std::uint8_t> Imager::expose(const std::vector<float>& light,
                                         std::uint64_t frame) const {
  std::vector<std::uint8_t> bytes(light.size());
  const float gain = gain_ * brightness(frame);
  const auto noise_gain = static_cast<float>(options_.image_noise);
  Random random(options_.seed, 0x1aa9e, frame);
  std::size_t from = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (i % 64 == 0) from = random.bits();
    const float grey = saturated(gain * light[i] * vignetting_[i]);
    const float sigma = noise_gain * std::sqrt(kReadoutGrey2 + kShotGreyPerGrey * grey);
    const float seen = grey + sigma * noise_[(from + i) & (kNoiseValues - 1)];
    bytes[i] = static_cast<std::uint8_t>(std::clamp(seen + 0.5F, 0.0F, 255.0F));
  }
  return bytes;
}

}  // namespace sparsight::simulated
