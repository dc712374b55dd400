#pragma once

#include <cstddef>
#include <optional>

#include "hal/frame_source.h"
#include "tests/synthetic/scene.h"

namespace sparsight::synthetic {

// A scene's frames without a disk between.
class SyntheticSource final : public FrameSource {
 public:
  SyntheticSource(Scene scene, std::size_t frames);

  const RigCalibration& calibration() const override { return scene_.rig; }
  std::optional<std::size_t> frame_count() const override { return frames_; }
  std::optional<SynchronizedFrame> next() override;

  // True pose of a frame's camera in the first one's: what an odometry should say.
  Eigen::Isometry3d T_first_camera(std::size_t frame) const;
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
  std::size_t frames_;
  std::size_t position_ = 0;
};

}  // namespace sparsight::synthetic
