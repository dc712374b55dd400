#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sparsight::synthetic {

// Extent of what one sample averages over, metres along u and v of a surface.
struct Footprint {
  double u = 0.0;
  double v = 0.0;

  double largest() const { return u > v ? u : v; }
};

// Gradient noise (Perlin 1985) of unit wavelength: smooth, zero mean, within about [-1, 1].
double gradient_noise(double u, double v, std::uint64_t seed);

// Sum of octaves from `longest` to `shortest` wavelength (metres), each `falloff` times the last.
// What is finer than two footprints is left out, so that a rendering does not alias.
struct OctaveNoise {
  double longest = 1.0;
  double shortest = 0.01;
  double falloff = 0.7;
  std::uint64_t seed = 0;

  double operator()(const Eigen::Vector2d& uv, const Footprint& footprint) const;
};

// A random value in [-1, 1] per cell of a grid, averaged exactly over the footprint: straight edges
// that stay sharp at every distance.
double cell_noise(const Eigen::Vector2d& uv, const Eigen::Vector2d& cell,
                  const Footprint& footprint, std::uint64_t seed);

// Share of the interval [x - width/2, x + width/2] covered by pulses [0, duty) repeated with
// period 1.
double pulse_coverage(double x, double duty, double width);

// Share of the interval that lies above the edge.
double step_coverage(double x, double edge, double width);

}  // namespace sparsight::synthetic
