#include "drivers/datasets/rings_by_wrap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sparsight {
namespace {

// A ring starts over where the azimuth falls back by this share of the scan's extent. Motion
// compensation moves near points back by a few degrees (3.1 in KITTI's sequence 04); a ring may
// begin late or end early where the sky returns nothing.
constexpr float kWrapShare = 0.125F;
// Closer to the seam than this, a return may lie on the wrong side of it.
constexpr float kSeamJitterDegrees = 1.0F;
// Steps shorter than this are between neighbours of a ring and show its direction.
constexpr float kNeighbourDegrees = 5.0F;
// Ring after ring nearly all steps go one way (KITTI: 88 % to 99.9 %); in other orders about half.
constexpr double kMinDirectedShare = 0.75;
constexpr std::size_t kSampledSteps = 10000;
// A gap narrower than this is a hole in a full turn.
constexpr float kMinGapDegrees = 10.0F;
// A single ring is level; one turn of a scan in firing order covers the field of view.
constexpr float kSingleRingDegrees = 2.0F;

// Lasers of one scanner stand at least so far apart, several times the noise along a ring.
constexpr float kMinLaserStepDegrees = 0.05F;
// A seam counts only if so many rings meet there.
constexpr double kMinMeetingShare = 0.2;

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

float shortest_step(float from, float to) { return wrapped_360(to - from + 180.0F) - 180.0F; }

// +1 or -1: the way the azimuth runs. 0: returns are not stored along rings.
float direction_of(const ScanAngles& angles) {
  std::size_t up = 0;
  std::size_t down = 0;
  std::vector<float> across;
  std::vector<float> along;
  // Medians and majorities do not need every return.
  const std::size_t stride = 1 + angles.azimuth.size() / kSampledSteps;
  for (std::size_t i = 1; i < angles.azimuth.size(); i += stride) {
    const float step = shortest_step(angles.azimuth[i - 1], angles.azimuth[i]);
    across.push_back(std::abs(angles.elevation[i] - angles.elevation[i - 1]));
    along.push_back(std::abs(step));
    if (std::abs(step) > kNeighbourDegrees) continue;
    up += step > 0 ? 1 : 0;
    down += step < 0 ? 1 : 0;
  }
  if (up + down == 0 || median(std::move(across)) > median(std::move(along))) return 0.0F;
  const double share = static_cast<double>(std::max(up, down)) / static_cast<double>(up + down);
  if (share < kMinDirectedShare) return 0.0F;
  return up > down ? 1.0F : -1.0F;
}

// Azimuth measured from the seam in the direction of storage, with the empty sector left out.
class Dial {
 public:
  Dial(float seam, float direction, const AzimuthGap& gap) : seam_(seam), direction_(direction) {
    if (gap.width < kMinGapDegrees) return;
    gap_width_ = gap.width;
    gap_center_ = wrapped_360(direction * (gap.center - seam));
    // A seam within the gap leaves no gap between the ends.
    if (std::min(gap_center_, 360.0F - gap_center_) < 0.5F * gap.width) gap_center_ = 360.0F;
    extent_ = 360.0F - gap_width_;
  }
  float extent() const { return extent_; }
  float position(float azimuth) const {
    const float turned = wrapped_360(direction_ * (azimuth - seam_));
    return turned > gap_center_ ? turned - gap_width_ : turned;
  }

 private:
  float seam_;
  float direction_;
  float gap_center_ = 360.0F;
  float gap_width_ = 0.0F;
  float extent_ = 360.0F;
};

struct Segmentation {
  std::vector<std::uint16_t> ring;
  // How far up or down it typically goes where one ring's end and the next one's start are next to
  // each other in azimuth; 0 where they hardly ever are. At a wrong seam both are the same laser.
  float laser_step = 0.0F;
};

// How far the elevation leaps to return i, beyond the slope on the smoother side of it: the rows of
// a depth image are level nowhere but in the middle.
float elevation_leap(const std::vector<float>& elevation, std::size_t i) {
  const float leap = elevation[i] - elevation[i - 1];
  const float before = i >= 2 ? elevation[i - 1] - elevation[i - 2] : 0.0F;
  const float after = i + 1 < elevation.size() ? elevation[i + 1] - elevation[i] : 0.0F;
  return std::min(std::abs(leap - before), std::abs(leap - after));
}

Segmentation segment(const ScanAngles& angles, const Dial& dial) {
  Segmentation result;
  result.ring.reserve(angles.azimuth.size());
  std::vector<float> laser_steps;
  int ring = 0;
  int wraps = 0;
  float last = dial.position(angles.azimuth.front());
  for (std::size_t i = 0; i < angles.azimuth.size(); ++i) {
    const float position = dial.position(angles.azimuth[i]);
    if (position - last < -kWrapShare * dial.extent()) {
      ++wraps;
      ring = std::min<int>(ring + 1, std::numeric_limits<std::uint16_t>::max());
      if (std::abs(shortest_step(angles.azimuth[i - 1], angles.azimuth[i])) < kNeighbourDegrees) {
        laser_steps.push_back(elevation_leap(angles.elevation, i));
      }
    } else if (position - last > dial.extent() - kSeamJitterDegrees && ring > 0) {
      --ring;
    }
    result.ring.push_back(static_cast<std::uint16_t>(ring));
    last = position;
  }
  if (static_cast<double>(laser_steps.size()) > kMinMeetingShare * wraps) {
    result.laser_step = median(std::move(laser_steps));
  }
  return result;
}

// Of the seams where rings meet, the one with a laser on either side; the scan's edge if there is
// none.
Segmentation best_segmentation(const ScanAngles& angles, float direction) {
  const AzimuthGap gap = widest_gap(angles.azimuth);
  // The first return's own azimuth covers a turn that starts anywhere; half the jitter before it.
  const float first = angles.azimuth.front() - direction * 0.5F * kSeamJitterDegrees;
  Segmentation best;
  best.laser_step = kMinLaserStepDegrees;
  for (const float seam : {0.0F, 180.0F, first}) {
    Segmentation candidate = segment(angles, Dial(seam, direction, gap));
    if (candidate.laser_step > best.laser_step) best = std::move(candidate);
  }
  return best.ring.empty() ? segment(angles, Dial(gap.center, direction, gap)) : best;
}

// A last ring of a handful of returns at the height of the one before is that ring's own end, just
// past the seam.
void join_spilled_end(const ScanAngles& angles, std::vector<std::uint16_t>& ring) {
  constexpr std::size_t kHandful = 5;
  constexpr float kSameLaserDegrees = 0.2F;
  std::size_t begin = ring.size() - 1;
  while (begin > 0 && ring[begin - 1] == ring.back()) --begin;
  if (begin == 0 || ring.size() - begin > kHandful) return;
  const float step = std::abs(angles.elevation[begin] - angles.elevation[begin - 1]);
  if (step > kSameLaserDegrees) return;
  std::fill(ring.begin() + static_cast<std::ptrdiff_t>(begin), ring.end(), ring[begin - 1]);
}

}  // namespace

std::optional<std::vector<std::uint16_t>> rings_by_wrap(const ScanAngles& angles) {
  if (angles.azimuth.empty()) return std::nullopt;
  if (angles.azimuth.size() == 1) return std::vector<std::uint16_t>{0};
  const float direction = direction_of(angles);
  if (direction == 0.0F) return std::nullopt;
  Segmentation best = best_segmentation(angles, direction);
  join_spilled_end(angles, best.ring);
  const auto [low, high] = std::minmax_element(angles.elevation.begin(), angles.elevation.end());
  if (best.ring.back() <= 1 && *high - *low > kSingleRingDegrees) return std::nullopt;
  return std::move(best.ring);
}

}  // namespace sparsight
