#include "tests/synthetic/bounding_hierarchy.h"

#include <gtest/gtest.h>

#include "tests/synthetic/random.h"

namespace sparsight::synthetic {
namespace {

std::vector<Shape> heap_of_shapes(int count, Random& random) {
  std::vector<Shape> shapes;
  for (int i = 0; i < count; ++i) {
    Shape shape;
    shape.kind = i % 2 == 0 ? Shape::Kind::kBox : Shape::Kind::kEllipsoid;
    shape.T_parent_shape.translation() =
        Eigen::Vector3d(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
    shape.half_size = {random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2)};
    shape.sides = std::make_shared<const Material>();
    shape.id = static_cast<std::uint32_t>(i);
    shapes.push_back(shape);
  }
  return shapes;
}

TEST(BoundingHierarchy, FindsWhatTryingEveryShapeFinds) {
  Random random(3);
  const std::vector<Shape> shapes = heap_of_shapes(200, random);
  const BoundingHierarchy hierarchy(shapes);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray{
        {random.uniform(-25, 25), random.uniform(-25, 25), random.uniform(-25, 25)},
        Eigen::Vector3d(random.gaussian(1), random.gaussian(1), random.gaussian(1)).normalized()};
    std::optional<Hit> nearest;
    for (const Shape& shape : shapes) {
      const auto hit = shape.intersect(ray, nearest ? nearest->distance : 1000.0);
      if (hit) nearest = hit;
    }
    const auto found = hierarchy.intersect(ray, 1000.0);
    ASSERT_EQ(found.has_value(), nearest.has_value());
    if (!found) continue;
    ++met;
    EXPECT_EQ(found->distance, nearest->distance);
    EXPECT_EQ(found->surface, nearest->surface);
  }
  EXPECT_GT(met, 200);
}

TEST(BoundingHierarchy, OfNothingMeetsNothing) {
  const BoundingHierarchy empty({});
  EXPECT_FALSE(empty.intersect({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, 10.0));
}

}  // namespace
}  // namespace sparsight::synthetic
