#pragma once

#include <Eigen/Core>
#include <array>

namespace sparsight::simulated {

// A flat surface with four corners, the only shape of the simulated world. Seen from its front the
// corners go from the lower left counter-clockwise.
struct Panel {
  std::array<Eigen::Vector3f, 4> corners;
  int material = 0;
  Eigen::Vector2f offset = Eigen::Vector2f::Zero();  // where its unevenness begins, metres
  // Of a round body: the normals at the left and right edge, by which it is lit.
  bool round = false;
  Eigen::Vector3f left_normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f right_normal = Eigen::Vector3f::Zero();

  Eigen::Vector3f normal() const {
    return (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
  }
};

}  // namespace sparsight::simulated
