#include "tests/synthetic/shape.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace sparsight::synthetic {
namespace {

Shape any_shape() {
  Shape shape;
  shape.kind =
      *rc::gen::element(Shape::Kind::kBox, Shape::Kind::kCylinder, Shape::Kind::kEllipsoid);
  const auto length = [] { return *rc::gen::inRange(100, 3000) / 1000.0; };
  shape.half_size = {length(), length(), length()};
  if (shape.kind == Shape::Kind::kCylinder) shape.half_size.y() = shape.half_size.x();
  const double yaw = *rc::gen::inRange(-314, 314) / 100.0;
  shape.T_parent_shape.linear() =
      Eigen::AngleAxisd(yaw, Eigen::Vector3d(0.3, -0.2, 0.9).normalized()).toRotationMatrix();
  shape.T_parent_shape.translation() = Eigen::Vector3d(8.0, length(), -length());
  shape.sides = std::make_shared<const Material>();
  return shape;
}

Ray any_ray() {
  const auto sideways = [] { return *rc::gen::inRange(-400, 400) / 1000.0; };
  return {Eigen::Vector3d(sideways(), sideways(), sideways()),
          Eigen::Vector3d(1.0, sideways(), sideways()).normalized()};
}

// Negative inside, zero on the surface.
double implicit(const Shape& shape, const Eigen::Vector3d& p_parent) {
  const Eigen::Vector3d p = shape.T_parent_shape.inverse() * p_parent;
  const Eigen::Vector3d q = p.cwiseQuotient(shape.half_size);
  if (shape.kind == Shape::Kind::kBox) return q.cwiseAbs().maxCoeff() - 1.0;
  if (shape.kind == Shape::Kind::kEllipsoid) return q.norm() - 1.0;
  return std::max(q.head<2>().norm(), std::abs(q.z())) - 1.0;
}

TEST(Shape, RayMeetsTheNearFaceOfABox) {
  Shape box;
  box.T_parent_shape.translation() = Eigen::Vector3d(10.0, 0.0, 0.0);
  box.half_size = {2.0, 1.0, 1.0};
  const auto hit = box.intersect({{0.0, 0.5, 0.25}, Eigen::Vector3d::UnitX()}, 100.0);
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->distance, 8.0);
  EXPECT_TRUE(hit->normal.isApprox(-Eigen::Vector3d::UnitX()));
  EXPECT_DOUBLE_EQ(hit->uv.y(), 1.25);  // above the box's foot
}

TEST(Shape, NothingIsMetBeyondTheDistanceAskedFor) {
  Shape box;
  box.T_parent_shape.translation() = Eigen::Vector3d(10.0, 0.0, 0.0);
  EXPECT_FALSE(box.intersect({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, 8.9));
  EXPECT_TRUE(box.intersect({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, 9.1));
}

RC_GTEST_PROP(Shape, HitsLieOnTheSurfaceAndNothingLiesBefore, ()) {
  const Shape shape = any_shape();
  const Ray ray = any_ray();
  const auto hit = shape.intersect(ray, 100.0);
  const double end = hit ? hit->distance : 30.0;
  if (hit) {
    RC_ASSERT(std::abs(implicit(shape, ray.origin + end * ray.direction)) < 1e-6);
    RC_ASSERT(hit->normal.dot(ray.direction) < 1e-9);
    RC_ASSERT(std::abs(hit->tangent_u.dot(hit->normal)) < 1e-9);
    RC_ASSERT(std::abs(hit->tangent_v.dot(hit->normal)) < 1e-9);
  }
  for (double distance = 0.0; distance < end - 1e-3; distance += 0.05) {
    RC_ASSERT(implicit(shape, ray.origin + distance * ray.direction) > -1e-9);
  }
}

RC_GTEST_PROP(Shape, BoundsHoldEveryHit, ()) {
  const Shape shape = any_shape();
  Ray ray = any_ray();
  ray.direction = (shape.T_parent_shape.translation() - ray.origin).normalized();
  const auto hit = shape.intersect(ray, 100.0);
  RC_ASSERT(hit.has_value());
  const Eigen::Vector3d p = ray.origin + hit->distance * ray.direction;
  RC_ASSERT(shape.bounds().exteriorDistance(p) < 1e-9);
}

}  // namespace
}  // namespace sparsight::synthetic
