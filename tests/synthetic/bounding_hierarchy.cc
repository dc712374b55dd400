#include "tests/synthetic/bounding_hierarchy.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sparsight::synthetic {
namespace {

constexpr std::uint32_t kLeafSize = 2;

// Distance at which the ray enters the box; infinite when it passes by.
double entry(const Eigen::AlignedBox3d& box, const Ray& ray, const Eigen::Vector3d& inverse) {
  double near = 0.0;
  double far = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double a = (box.min()[i] - ray.origin[i]) * inverse[i];
    const double b = (box.max()[i] - ray.origin[i]) * inverse[i];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? near : std::numeric_limits<double>::infinity();
}

}  // namespace

BoundingHierarchy::BoundingHierarchy(std::vector<Shape> shapes) : shapes_(std::move(shapes)) {
  if (shapes_.empty()) return;
  nodes_.reserve(2 * shapes_.size());
  build(0, static_cast<std::uint32_t>(shapes_.size()));
}

Eigen::AlignedBox3d BoundingHierarchy::bounds() const {
  return nodes_.empty() ? Eigen::AlignedBox3d() : nodes_.front().box;
}

std::uint32_t BoundingHierarchy::build(std::uint32_t first, std::uint32_t count) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Eigen::AlignedBox3d box;
  Eigen::AlignedBox3d centres;
  for (std::uint32_t i = first; i < first + count; ++i) {
    box.extend(shapes_[i].bounds());
    centres.extend(shapes_[i].T_parent_shape.translation());
  }
  nodes_[index].box = box;
  if (count <= kLeafSize) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  const auto begin = shapes_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [axis](const Shape& a, const Shape& b) {
    const double x = a.T_parent_shape.translation()[axis];
    const double y = b.T_parent_shape.translation()[axis];
    return x != y ? x < y : a.id < b.id;
  });
  build(first, half);
  const std::uint32_t right = build(first + half, count - half);
  nodes_[index].first = right;
  return index;
}

std::optional<Hit> BoundingHierarchy::intersect(const Ray& ray, double max_distance) const {
  if (nodes_.empty()) return std::nullopt;
  const Eigen::Vector3d inverse = ray.direction.cwiseInverse();
  std::optional<Hit> nearest;
  std::array<std::pair<std::uint32_t, double>, 64> stack;
  std::size_t depth = 0;
  stack[depth++] = {0U, entry(nodes_[0].box, ray, inverse)};
  while (depth > 0) {
    const auto [index, distance] = stack[--depth];
    if (distance >= max_distance) continue;
    const Node& node = nodes_[index];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (const auto hit = shapes_[i].intersect(ray, max_distance)) {
        nearest = hit;
        max_distance = hit->distance;
      }
    }
    if (node.count > 0) continue;
    std::pair left{index + 1, entry(nodes_[index + 1].box, ray, inverse)};
    std::pair right{node.first, entry(nodes_[node.first].box, ray, inverse)};
    if (left.second < right.second) std::swap(left, right);
    stack[depth++] = left;
    stack[depth++] = right;
  }
  return nearest;
}

}  // namespace sparsight::synthetic
