#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "tests/synthetic/noise.h"

namespace sparsight::synthetic {

// Layers add to the base tone of a material. Grey levels of an 8-bit image at nominal exposure;
// lengths in metres on the surface.

// Asphalt, plaster, grass: smooth at every scale.
struct Grain {
  double amplitude;
  OctaveNoise noise;
};

// Foliage, stains, prints: blotches with an outline, from smooth noise cut at zero.
struct Blotches {
  double amplitude;
  OctaveNoise noise;
};

// Bricks, books, paving: rectangles of random tone, `octaves` halvings of the size.
struct Patches {
  double amplitude;
  Eigen::Vector2d size;
  int octaves = 1;
  std::uint64_t seed = 0;
};

// Joints and mullions: lines every `period` along u and v; a period of zero leaves the axis out.
struct Lines {
  double tone;
  Eigen::Vector2d period;
  double width;
};

// Windows: a rectangle of `size` in each cell of `period`, at `offset` from its corner.
struct Panels {
  double tone;
  double variation;  // from one panel to the next
  Eigen::Vector2d period;
  Eigen::Vector2d size;
  Eigen::Vector2d offset;
  std::uint64_t seed = 0;
};

// A stripe along u between two values of v.
struct Band {
  double tone;
  double v_low;
  double v_high;
};

// A road along u whose centre line is v = bend(u); the marks follow it.
struct RoadBend {
  double amplitude = 0.0;  // metres to either side
  double wavelength = 1000.0;

  double offset(double u) const;
  double slope(double u) const;
};

struct RoadMarks {
  struct Line {
    double offset;  // from the centre line, metres to the left
    double width;
    double period = 0.0;  // of the dashes; zero is an unbroken line
    double duty = 1.0;
  };
  RoadBend bend;
  double half_width = 6.0;
  double verge_tone = 0.0;  // of what lies beyond the road's edges
  double verge_grain = 0.0;
  double line_tone = 0.0;
  std::vector<Line> lines;
};

using Layer = std::variant<Grain, Blotches, Patches, Lines, Panels, Band, RoadMarks>;

struct Material {
  double base = 128.0;
  std::vector<Layer> layers;
  double reflectivity = 0.4;     // what the LiDAR reports as intensity
  double range_scatter_m = 0.0;  // foliage returns a beam from anywhere in its outer metre

  // Grey averaged over the footprint, before shading.
  double grey(const Eigen::Vector2d& uv, const Footprint& footprint) const;
};

using MaterialRef = std::shared_ptr<const Material>;

}  // namespace sparsight::synthetic
