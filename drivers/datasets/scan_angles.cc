#include "drivers/datasets/scan_angles.h"

#include <array>
#include <cmath>
#include <numbers>

namespace sparsight {
namespace {

constexpr float kDegreesPerRadian = 180.0F / std::numbers::pi_v<float>;
constexpr std::size_t kSectors = 720;
constexpr float kSectorDegrees = 360.0F / kSectors;

}  // namespace

float wrapped_360(float degrees) {
  // A step or two: callers are never more than a turn away, and std::floor is a call on plain
  // x86-64.
  while (degrees < 0.0F) degrees += 360.0F;  // a tiny negative angle rounds up to 360
  while (degrees >= 360.0F) degrees -= 360.0F;
  return degrees;
}

ScanAngles scan_angles(const std::vector<LidarReturn>& returns) {
  ScanAngles angles;
  angles.azimuth.reserve(returns.size());
  angles.elevation.reserve(returns.size());
  for (const LidarReturn& point : returns) {
    const Eigen::Vector3f& p = point.p_lidar;
    angles.azimuth.push_back(wrapped_360(std::atan2(p.y(), p.x()) * kDegreesPerRadian));
    angles.elevation.push_back(std::atan2(p.z(), std::hypot(p.x(), p.y())) * kDegreesPerRadian);
  }
  return angles;
}

AzimuthGap widest_gap(const std::vector<float>& azimuth) {
  std::array<bool, kSectors> occupied{};
  for (const float a : azimuth) {
    occupied[static_cast<std::size_t>(a / kSectorDegrees) % kSectors] = true;
  }
  std::size_t widest = 0;
  std::size_t widest_end = 0;
  std::size_t run = 0;
  // Twice around, so that a gap across 0 is seen whole.
  for (std::size_t i = 0; i < 2 * kSectors; ++i) {
    run = occupied[i % kSectors] ? 0 : run + 1;
    if (run > widest) {
      widest = run;
      widest_end = i + 1;
    }
  }
  const float width = kSectorDegrees * static_cast<float>(std::min(widest, kSectors));
  return {wrapped_360(kSectorDegrees * static_cast<float>(widest_end) - 0.5F * width), width};
}

}  // namespace sparsight
