#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "tests/synthetic/bounding_hierarchy.h"
#include "tests/synthetic/random.h"
#include "tests/synthetic/shape.h"

namespace sparsight::synthetic {

// Gathers the shapes of a scene. Things stand on their `foot`, the middle of their underside.
class Builder {
 public:
  void box(const Eigen::Vector3d& foot, const Eigen::Vector3d& size, const MaterialRef& sides,
           double yaw = 0.0, const MaterialRef& top = nullptr);
  void post(const Eigen::Vector3d& foot, double radius, double height, const MaterialRef& material);
  void blob(const Eigen::Vector3d& centre, const Eigen::Vector3d& half_size,
            const MaterialRef& material);
  // A trunk and a crown of overlapping blobs.
  void tree(const Eigen::Vector3d& foot, double height, Random& random);

  std::shared_ptr<const BoundingHierarchy> finish();

 private:
  void add(Shape::Kind kind, const Eigen::Vector3d& centre, const Eigen::Vector3d& half_size,
           double yaw, const MaterialRef& sides, const MaterialRef& top);

  std::vector<Shape> shapes_;
};

// A car of about 4.4 m that stands on the origin and looks along x; `scale` makes vans of it.
std::shared_ptr<const BoundingHierarchy> make_car(Random& random, double length_m = 4.4,
                                                  double height_m = 1.5);
void add_car(Builder& builder, const Eigen::Vector3d& foot, double yaw, Random& random,
             double length_m = 4.4, double height_m = 1.5);

}  // namespace sparsight::synthetic
