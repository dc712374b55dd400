#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "drivers/simulated/world.h"
#include "hal/calibration.h"

namespace sparsight::simulated {

// Looks at the world through the lens. One look into every pixel, with textures averaged over it;
// pixels at the edges of bodies get eight. In colour, each pixel sees what its place in the Bayer
// pattern lets through. Thread-safe.
class FrameRenderer {
 public:
  FrameRenderer(const World& world, const CameraIntrinsics& camera, bool color = false);

  // Light per pixel, row after row.
  std::vector<float> render(const Eigen::Isometry3d& T_world_camera) const;
  // Depth (z in the camera frame) per pixel; infinite where there is nothing.
  std::vector<float> depth(const Eigen::Isometry3d& T_world_camera) const;

 private:
  struct View {
    Eigen::Matrix3f R;
    Eigen::Vector3f origin;
  };
  std::vector<Hit> first_hits(const View& view) const;
  std::vector<int> edge_pixels(const std::vector<Hit>& hits) const;
  void refine(const View& view, const std::vector<int>& pixels, std::vector<float>& light) const;
  float light_of(const View& view, const Hit& hit, const Eigen::Vector2f& on_plane,
                 float pixel) const;

  float share_of(const Hit& hit, std::size_t pixel) const;

  const World& world_;
  bool color_;
  int width_;
  int height_;
  float brightest_;
  Eigen::Vector2f step_;  // of a pixel on the plane z = 1
  std::vector<Eigen::Vector2f> rays_;
};

}  // namespace sparsight::simulated
