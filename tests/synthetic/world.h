#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "tests/synthetic/bounding_hierarchy.h"
#include "tests/synthetic/shape.h"

namespace sparsight::synthetic {

// World frame: x forward at the start, y left, z up; seconds since the start.

// Something that moves as a whole: a car, a person.
struct Mover {
  std::function<Eigen::Isometry3d(double seconds)> T_world_mover;
  std::shared_ptr<const BoundingHierarchy> shapes;
};

// The light of a scene, in the simplest form that leaves no two faces of a box alike.
struct Light {
  Eigen::Vector3d towards = Eigen::Vector3d(0.3, 0.5, 0.8).normalized();
  double ambient = 0.6;
  double directed = 0.4;
  bool sky = true;  // what is seen where nothing is hit; else black
};

struct World {
  std::shared_ptr<const BoundingHierarchy> still;
  std::vector<Mover> movers;
  MaterialRef ground;  // the plane z = 0 where given; u = x, v = y
  Light light;
};

// The world at one instant; camera and LiDAR rays go through this one function.
class Snapshot {
 public:
  Snapshot(const World& world, double seconds);

  std::optional<Hit> intersect(const Ray& ray_world, double max_distance) const;

 private:
  struct Placed {
    Eigen::Isometry3d T_world_mover;
    const BoundingHierarchy* shapes;
    std::uint32_t id;
  };

  std::optional<Hit> meet_ground(const Ray& ray, double max_distance) const;

  const World& world_;
  std::vector<Placed> movers_;
};

}  // namespace sparsight::synthetic
