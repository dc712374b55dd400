#include "tests/synthetic/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/synthetic/random.h"

namespace sparsight::synthetic {
namespace {

// Sixteen directions, evenly spread.
const std::array<Eigen::Vector2d, 16>& directions() {
  static const auto kDirections = [] {
    std::array<Eigen::Vector2d, 16> result;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double angle = 2.0 * M_PI * static_cast<double>(i) / 16.0;
      result[i] = {std::cos(angle), std::sin(angle)};
    }
    return result;
  }();
  return kDirections;
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

// How much of a wave survives averaging: all when four footprints long, nothing below two.
double surviving(double wavelength, double footprint) {
  if (footprint <= 0.0) return 1.0;
  return std::clamp((wavelength / footprint - 2.0) / 2.0, 0.0, 1.0);
}

struct CellShare {
  std::int64_t first;
  double second_share;  // of the cell after `first`
};

CellShare cells_below(double x, double width) {
  const double low = std::floor(x - width / 2.0);
  return {static_cast<std::int64_t>(low),
          width > 0.0 ? std::clamp((x + width / 2.0 - low - 1.0) / width, 0.0, 1.0) : 0.0};
}

}  // namespace

double gradient_noise(double u, double v, std::uint64_t seed) {
  const double floor_u = std::floor(u);
  const double floor_v = std::floor(v);
  const auto corner = [&](int i, int j) {
    const std::uint64_t bits =
        hash(seed, static_cast<std::int64_t>(floor_u) + i, static_cast<std::int64_t>(floor_v) + j);
    return directions()[bits & 15U].dot(Eigen::Vector2d(u - floor_u - i, v - floor_v - j));
  };
  const double a = fade(u - floor_u);
  const double b = fade(v - floor_v);
  const double low = std::lerp(corner(0, 0), corner(1, 0), a);
  const double high = std::lerp(corner(0, 1), corner(1, 1), a);
  return 1.4 * std::lerp(low, high, b);
}

double OctaveNoise::operator()(const Eigen::Vector2d& uv, const Footprint& footprint) const {
  double sum = 0.0;
  double amplitude = 1.0;
  std::uint64_t octave = seed;
  for (double wavelength = longest; wavelength >= shortest; wavelength /= 2.0) {
    const double share = surviving(wavelength, footprint.largest());
    if (share == 0.0) break;
    // An offset per octave: lattices that share the origin would all be zero there.
    octave = hash(octave + 1);
    const double shift = unit_interval(octave);
    sum += share * amplitude *
           gradient_noise(uv.x() / wavelength + shift, uv.y() / wavelength + shift, octave);
    amplitude *= falloff;
  }
  return sum;
}

double cell_noise(const Eigen::Vector2d& uv, const Eigen::Vector2d& cell,
                  const Footprint& footprint, std::uint64_t seed) {
  const Eigen::Vector2d width(footprint.u / cell.x(), footprint.v / cell.y());
  const double contrast = 1.0 / (std::max(width.x(), 1.0) * std::max(width.y(), 1.0));
  const CellShare u = cells_below(uv.x() / cell.x(), std::min(width.x(), 1.0));
  const CellShare v = cells_below(uv.y() / cell.y(), std::min(width.y(), 1.0));
  const auto value = [&](int i, int j) {
    return 2.0 * unit_interval(hash(seed, u.first + i, v.first + j)) - 1.0;
  };
  const double low = std::lerp(value(0, 0), value(1, 0), u.second_share);
  const double high = std::lerp(value(0, 1), value(1, 1), u.second_share);
  return contrast * std::lerp(low, high, v.second_share);
}

double pulse_coverage(double x, double duty, double width) {
  const auto integral = [duty](double end) {
    const double whole = std::floor(end);
    return whole * duty + std::min(end - whole, duty);
  };
  if (width <= 1e-9) return x - std::floor(x) < duty ? 1.0 : 0.0;
  return (integral(x + width / 2.0) - integral(x - width / 2.0)) / width;
}

double step_coverage(double x, double edge, double width) {
  if (width <= 1e-9) return x >= edge ? 1.0 : 0.0;
  return std::clamp((x - edge) / width + 0.5, 0.0, 1.0);
}

}  // namespace sparsight::synthetic
