#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>

#include "tests/synthetic/material.h"

namespace sparsight::synthetic {

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // unit length
};

// Where a ray meets a surface, in the frame the ray was given in.
struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();     // outward
  Eigen::Vector3d tangent_u = Eigen::Vector3d::UnitX();  // direction of growing u
  Eigen::Vector3d tangent_v = Eigen::Vector3d::UnitY();
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();  // metres on the surface
  const Material* material = nullptr;
  std::uint32_t surface = 0;  // differs where two neighbouring pixels see different faces
};

// Boxes make rooms, buildings and cars; cylinders (axis z) trunks and posts; ellipsoids foliage.
struct Shape {
  enum class Kind : std::uint8_t { kBox, kCylinder, kEllipsoid };

  Kind kind = Kind::kBox;
  Eigen::Isometry3d T_parent_shape = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_size = Eigen::Vector3d::Ones();
  MaterialRef sides;
  MaterialRef top;  // also the underside; none: as the sides
  std::uint32_t id = 0;

  Eigen::AlignedBox3d bounds() const;
  // The nearest surface in front of the ray; from inside a shape nothing is seen.
  std::optional<Hit> intersect(const Ray& ray_parent, double max_distance) const;
};

}  // namespace sparsight::synthetic
