#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "drivers/simulated/world.h"

namespace sparsight::simulated {

// Computes the light that falls on every surface: lamps and sun directly, sky and other walls over
// the hemisphere. Light does not change while the rig walks.
class LightBaker {
 public:
  explicit LightBaker(World& world);
  void bake();

 private:
  struct Lamp {
    Eigen::Vector3f corner;
    Eigen::Vector3f right;  // edges
    Eigen::Vector3f up;
    Eigen::Vector3f normal;
    float power;  // emission times area
  };
  struct Place {
    Eigen::Vector3f at;
    Eigen::Vector3f normal;
  };

  void bake_panel(std::size_t index);
  Place place(std::size_t index, int column, int row) const;
  float from_lamps(const Place& place) const;
  float from_sun(const Place& place) const;
  // Negative: the place lies inside another body.
  float from_around(const Place& place) const;

  World& world_;
  std::vector<Lamp> lamps_;
  std::vector<Eigen::Vector3f> hemisphere_;  // cosine-weighted directions about z
};

}  // namespace sparsight::simulated
