#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "slam/points/camera_returns.h"

namespace sparsight {

// How inverse depth changes over the image around a return: a plane in space is exactly affine in
// inverse depth, so two numbers let every pixel of a patch have its own depth (road and walls are
// rarely seen face on). Fitted to the returns within about a degree; zero along a direction in
// which there are none, as across the rings of a sparse scanner.
class SurfaceSlopes {
 public:
  SurfaceSlopes(const std::vector<CameraReturn>& returns, const CameraModel& camera);

  // 1/(m px).
  Eigen::Vector2f at(std::size_t index) const;

 private:
  std::size_t cell_of(const Eigen::Vector2f& pixel) const;

  const std::vector<CameraReturn>& returns_;
  float cell_px_;
  int columns_;
  int rows_;
  std::vector<std::size_t> first_in_cell_;  // one past the last cell included
  std::vector<std::size_t> by_cell_;
};

}  // namespace sparsight
