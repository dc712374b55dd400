#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/synthetic/shape.h"

namespace sparsight::synthetic {

// Shapes that do not move relative to each other, in a tree of boxes split at the median, so that a
// ray visits a few of some thousand.
class BoundingHierarchy {
 public:
  explicit BoundingHierarchy(std::vector<Shape> shapes);

  std::optional<Hit> intersect(const Ray& ray, double max_distance) const;
  Eigen::AlignedBox3d bounds() const;
  std::size_t size() const { return shapes_.size(); }

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0;  // shape of a leaf, else the right child; the left child comes next
    std::uint32_t count = 0;  // shapes of a leaf, else 0
  };

  std::uint32_t build(std::uint32_t first, std::uint32_t count);

  std::vector<Shape> shapes_;
  std::vector<Node> nodes_;
};

}  // namespace sparsight::synthetic
