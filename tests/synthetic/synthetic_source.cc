#include "tests/synthetic/synthetic_source.h"

#include <cmath>
#include <utility>

namespace sparsight::synthetic {

SyntheticSource::SyntheticSource(Scene scene, std::size_t frames)
    : scene_(std::move(scene)), frames_(frames) {}

std::optional<SynchronizedFrame> SyntheticSource::next() {
  if (position_ >= frames_) return std::nullopt;
  SynchronizedFrame frame;
  frame.sequence = position_;
  frame.exposure =
      HostTime(std::chrono::nanoseconds(std::llround(scene_.exposure_s(position_) * 1e9)));
  frame.grey = scene_.image(position_);
  frame.sweep = scene_.sweep(position_);
  ++position_;
  return frame;
}

Eigen::Isometry3d SyntheticSource::T_first_camera(std::size_t frame) const {
  return scene_.T_world_camera(scene_.exposure_s(0)).inverse() *
         scene_.T_world_camera(scene_.exposure_s(frame));
}

}  // namespace sparsight::synthetic
