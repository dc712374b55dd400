#include "tests/synthetic/world.h"

namespace sparsight::synthetic {

Snapshot::Snapshot(const World& world, double seconds) : world_(world) {
  movers_.reserve(world.movers.size());
  for (const Mover& mover : world.movers) {
    movers_.push_back({mover.T_world_mover(seconds), mover.shapes.get(),
                       static_cast<std::uint32_t>(movers_.size() + 1U) << 24U});
  }
}

std::optional<Hit> Snapshot::meet_ground(const Ray& ray, double max_distance) const {
  if (!world_.ground || ray.direction.z() >= 0.0) return std::nullopt;
  const double distance = -ray.origin.z() / ray.direction.z();
  if (distance <= 0.0 || distance >= max_distance) return std::nullopt;
  Hit hit;
  hit.distance = distance;
  hit.uv = (ray.origin + distance * ray.direction).head<2>();
  hit.material = world_.ground.get();
  return hit;
}

std::optional<Hit> Snapshot::intersect(const Ray& ray_world, double max_distance) const {
  std::optional<Hit> nearest = meet_ground(ray_world, max_distance);
  if (nearest) max_distance = nearest->distance;
  if (auto hit = world_.still->intersect(ray_world, max_distance)) {
    nearest = hit;
    max_distance = hit->distance;
  }
  for (const Placed& mover : movers_) {
    const Eigen::Isometry3d& T = mover.T_world_mover;
    const Ray ray{T.linear().transpose() * (ray_world.origin - T.translation()),
                  T.linear().transpose() * ray_world.direction};
    auto hit = mover.shapes->intersect(ray, max_distance);
    if (!hit) continue;
    hit->normal = T.linear() * hit->normal;
    hit->tangent_u = T.linear() * hit->tangent_u;
    hit->tangent_v = T.linear() * hit->tangent_v;
    hit->surface |= mover.id;
    nearest = hit;
    max_distance = hit->distance;
  }
  return nearest;
}

}  // namespace sparsight::synthetic
