#include "tests/synthetic/scenes/builder.h"

#include <utility>

#include "tests/synthetic/scenes/palette.h"

namespace sparsight::synthetic {

void Builder::add(Shape::Kind kind, const Eigen::Vector3d& centre, const Eigen::Vector3d& half_size,
                  double yaw, const MaterialRef& sides, const MaterialRef& top) {
  Shape shape;
  shape.kind = kind;
  shape.T_parent_shape.linear() =
      Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  shape.T_parent_shape.translation() = centre;
  shape.half_size = half_size;
  shape.sides = sides;
  shape.top = top;
  shape.id = static_cast<std::uint32_t>(shapes_.size());
  shapes_.push_back(std::move(shape));
}

void Builder::box(const Eigen::Vector3d& foot, const Eigen::Vector3d& size,
                  const MaterialRef& sides, double yaw, const MaterialRef& top) {
  add(Shape::Kind::kBox, foot + Eigen::Vector3d(0.0, 0.0, size.z() / 2.0), size / 2.0, yaw, sides,
      top);
}

void Builder::post(const Eigen::Vector3d& foot, double radius, double height,
                   const MaterialRef& material) {
  add(Shape::Kind::kCylinder, foot + Eigen::Vector3d(0.0, 0.0, height / 2.0),
      {radius, radius, height / 2.0}, 0.0, material, nullptr);
}

void Builder::blob(const Eigen::Vector3d& centre, const Eigen::Vector3d& half_size,
                   const MaterialRef& material) {
  add(Shape::Kind::kEllipsoid, centre, half_size, 0.0, material, nullptr);
}

void Builder::tree(const Eigen::Vector3d& foot, double height, Random& random) {
  const MaterialRef leaves = foliage(random);
  post(foot, random.uniform(0.1, 0.25), 0.6 * height, bark(random));
  const int blobs = 4;
  for (int i = 0; i < blobs; ++i) {
    const double radius = height * random.uniform(0.16, 0.28);
    const Eigen::Vector3d centre =
        foot + Eigen::Vector3d(random.gaussian(0.12 * height), random.gaussian(0.12 * height),
                               height * random.uniform(0.5, 0.85));
    blob(centre, {radius, radius * random.uniform(0.8, 1.2), radius * random.uniform(0.7, 1.1)},
         leaves);
  }
}

std::shared_ptr<const BoundingHierarchy> Builder::finish() {
  return std::make_shared<const BoundingHierarchy>(std::move(shapes_));
}

void add_car(Builder& builder, const Eigen::Vector3d& foot, double yaw, Random& random,
             double length_m, double height_m) {
  const double width = 1.55 + 0.05 * length_m;
  const Eigen::Rotation2Dd turn(yaw);
  const auto at = [&](double x, double y, double z) {
    const Eigen::Vector2d p = turn * Eigen::Vector2d(x, y);
    return Eigen::Vector3d(foot + Eigen::Vector3d(p.x(), p.y(), z));
  };
  const MaterialRef body = car_body(random);
  const MaterialRef glass = car_glass(random);
  const double waist = 0.6 * height_m;
  builder.box(at(0.0, 0.0, 0.22), {length_m, width, waist - 0.22}, body, yaw);
  builder.box(at(-0.06 * length_m, 0.0, waist), {0.55 * length_m, 0.86 * width, height_m - waist},
              glass, yaw, body);
  for (const double x : {-0.3, 0.31}) {
    builder.box(at(x * length_m, 0.0, 0.0), {0.62, width + 0.04, 0.62}, tyre(), yaw);
  }
  builder.box(at(0.5 * length_m, 0.0, 0.4), {0.04, 0.5, 0.12}, plate(random), yaw);
  builder.box(at(-0.5 * length_m, 0.0, 0.5), {0.04, 0.5, 0.12}, plate(random), yaw);
  for (const double y : {-0.38, 0.38}) {
    builder.box(at(0.49 * length_m, y * width, 0.6), {0.1, 0.3, 0.14}, plate(random), yaw);
    builder.box(at(-0.49 * length_m, y * width, 0.6), {0.1, 0.25, 0.25}, tyre(), yaw);
  }
}

std::shared_ptr<const BoundingHierarchy> make_car(Random& random, double length_m,
                                                  double height_m) {
  Builder builder;
  add_car(builder, Eigen::Vector3d::Zero(), 0.0, random, length_m, height_m);
  return builder.finish();
}

}  // namespace sparsight::synthetic
