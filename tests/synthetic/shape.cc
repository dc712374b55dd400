#include "tests/synthetic/shape.h"

#include <cmath>
#include <utility>

namespace sparsight::synthetic {
namespace {

constexpr double kMinDistance = 1e-6;

std::optional<std::pair<double, int>> box_entry(const Ray& ray, const Eigen::Vector3d& half) {
  double entry = -std::numeric_limits<double>::infinity();
  double exit = std::numeric_limits<double>::infinity();
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    const double inverse = 1.0 / ray.direction[i];
    double near = (-half[i] - ray.origin[i]) * inverse;
    double far = (half[i] - ray.origin[i]) * inverse;
    if (near > far) std::swap(near, far);
    if (near > entry) {
      entry = near;
      axis = i;
    }
    exit = far < exit ? far : exit;
  }
  if (!(entry <= exit) || entry < kMinDistance) return std::nullopt;
  return std::pair{entry, axis};
}

std::optional<Hit> meet_box(const Ray& ray, const Eigen::Vector3d& half, double max_distance) {
  const auto entry = box_entry(ray, half);
  if (!entry || entry->first >= max_distance) return std::nullopt;
  const auto [distance, axis] = *entry;
  const Eigen::Vector3d p = ray.origin + distance * ray.direction;
  const double side = ray.direction[axis] < 0.0 ? 1.0 : -1.0;
  const int u_axis = axis == 0 ? 1 : 0;
  const int v_axis = axis == 2 ? 1 : 2;
  Hit hit;
  hit.distance = distance;
  hit.normal = side * Eigen::Vector3d::Unit(axis);
  hit.tangent_u = Eigen::Vector3d::Unit(u_axis);
  hit.tangent_v = Eigen::Vector3d::Unit(v_axis);
  // v of a side counts from the box's foot: storeys, skirting boards and car windows stand on it.
  // Opposite and neighbouring faces are moved apart, or they would show the same pattern.
  const double apart = 37.0 * (2 * axis + (side > 0.0 ? 1 : 0));
  hit.uv = {p[u_axis] + half[u_axis] + apart, p[v_axis] + half[v_axis]};
  hit.surface = static_cast<std::uint32_t>(2 * axis + (side > 0.0 ? 1 : 0));
  return hit;
}

std::optional<Hit> meet_cap(const Ray& ray, const Eigen::Vector3d& half, double max_distance) {
  const double side = ray.direction.z() < 0.0 ? 1.0 : -1.0;
  const double distance = (side * half.z() - ray.origin.z()) / ray.direction.z();
  if (!(distance > kMinDistance) || distance >= max_distance) return std::nullopt;
  const Eigen::Vector3d p = ray.origin + distance * ray.direction;
  if (p.head<2>().squaredNorm() > half.x() * half.x()) return std::nullopt;
  Hit hit;
  hit.distance = distance;
  hit.normal = side * Eigen::Vector3d::UnitZ();
  hit.uv = p.head<2>();
  hit.surface = 4;
  return hit;
}

std::optional<Hit> meet_mantle(const Ray& ray, const Eigen::Vector3d& half, double max_distance) {
  const Eigen::Vector2d o = ray.origin.head<2>();
  const Eigen::Vector2d d = ray.direction.head<2>();
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double root = b * b - a * (o.squaredNorm() - half.x() * half.x());
  if (root < 0.0 || a < 1e-12) return std::nullopt;
  const double distance = (-b - std::sqrt(root)) / a;
  if (distance < kMinDistance || distance >= max_distance) return std::nullopt;
  const Eigen::Vector3d p = ray.origin + distance * ray.direction;
  if (std::abs(p.z()) > half.z()) return std::nullopt;
  Hit hit;
  hit.distance = distance;
  hit.normal = Eigen::Vector3d(p.x(), p.y(), 0.0) / half.x();
  hit.tangent_u = Eigen::Vector3d(-p.y(), p.x(), 0.0) / half.x();
  hit.tangent_v = Eigen::Vector3d::UnitZ();
  hit.uv = {std::atan2(p.y(), p.x()) * half.x(), p.z() + half.z()};
  return hit;
}

std::optional<Hit> meet_ellipsoid(const Ray& ray, const Eigen::Vector3d& half,
                                  double max_distance) {
  const Eigen::Vector3d o = ray.origin.cwiseQuotient(half);
  const Eigen::Vector3d d = ray.direction.cwiseQuotient(half);
  const double a = d.squaredNorm();
  const double b = o.dot(d);
  const double root = b * b - a * (o.squaredNorm() - 1.0);
  if (root < 0.0) return std::nullopt;
  const double distance = (-b - std::sqrt(root)) / a;
  if (distance < kMinDistance || distance >= max_distance) return std::nullopt;
  const Eigen::Vector3d p = ray.origin + distance * ray.direction;
  Hit hit;
  hit.distance = distance;
  hit.normal = p.cwiseQuotient(half.cwiseAbs2()).normalized();
  hit.tangent_u = Eigen::Vector3d::UnitZ().cross(hit.normal).normalized();
  if (!hit.tangent_u.allFinite()) hit.tangent_u = Eigen::Vector3d::UnitX();
  hit.tangent_v = hit.normal.cross(hit.tangent_u);
  hit.uv = {std::atan2(p.y(), p.x()) * half.x(), p.z()};
  return hit;
}

std::optional<Hit> meet(Shape::Kind kind, const Ray& ray, const Eigen::Vector3d& half,
                        double max_distance) {
  if (kind == Shape::Kind::kBox) return meet_box(ray, half, max_distance);
  if (kind == Shape::Kind::kEllipsoid) return meet_ellipsoid(ray, half, max_distance);
  if (auto mantle = meet_mantle(ray, half, max_distance)) return mantle;
  return meet_cap(ray, half, max_distance);
}

}  // namespace

Eigen::AlignedBox3d Shape::bounds() const {
  const Eigen::Vector3d reach = T_parent_shape.linear().cwiseAbs() * half_size;
  const Eigen::Vector3d centre = T_parent_shape.translation();
  return {centre - reach, centre + reach};
}

std::optional<Hit> Shape::intersect(const Ray& ray_parent, double max_distance) const {
  const Eigen::Matrix3d R_shape_parent = T_parent_shape.linear().transpose();
  const Ray ray{R_shape_parent * (ray_parent.origin - T_parent_shape.translation()),
                R_shape_parent * ray_parent.direction};
  auto hit = meet(kind, ray, half_size, max_distance);
  if (!hit) return hit;
  const bool is_top = std::abs(hit->normal.z()) > 0.99 && kind != Kind::kEllipsoid;
  hit->material = is_top && top ? top.get() : sides.get();
  hit->surface += 8U * (id + 1U);
  hit->uv += Eigen::Vector2d(static_cast<double>(id % 97U) * 13.7, 0.0);
  hit->normal = T_parent_shape.linear() * hit->normal;
  hit->tangent_u = T_parent_shape.linear() * hit->tangent_u;
  hit->tangent_v = T_parent_shape.linear() * hit->tangent_v;
  return hit;
}

}  // namespace sparsight::synthetic
