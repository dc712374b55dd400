#include "tests/synthetic/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/synthetic/random.h"

namespace sparsight::synthetic {
namespace {

// Sixteen directions, evenly spread.
const std::array<Eigen::Vector2d, 16> kDirections = [] {
  std::array<Eigen::Vector2d, 16> result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double angle = 2.0 * M_PI * static_cast<double>(i) / 16.0;
    result[i] = {std::cos(angle), std::sin(angle)};
  }
  return result;
}();

// Without SSE 4.1, which the baseline build may not use, std::floor is a call.
std::int64_t floor_of(double x) {
  const auto truncated = static_cast<std::int64_t>(x);
  return truncated - (static_cast<double>(truncated) > x ? 1 : 0);
}

double mix(double from, double to, double share) { return from + share * (to - from); }

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
  const std::int64_t low = floor_of(x - width / 2.0);
  const double next = static_cast<double>(low) + 1.0;
  return {low, width > 0.0 ? std::clamp((x + width / 2.0 - next) / width, 0.0, 1.0) : 0.0};
}

}  // namespace

double gradient_noise(double u, double v, std::uint64_t seed) {
  // The lattice hash is one product a corner: a picture asks for some hundred million of them.
  constexpr std::uint64_t kAlongU = 0x9e3779b97f4a7c15ULL;
  constexpr std::uint64_t kAlongV = 0xc2b2ae3d27d4eb4fULL;
  const std::int64_t cell_u = floor_of(u);
  const std::int64_t cell_v = floor_of(v);
  const double x = u - static_cast<double>(cell_u);
  const double y = v - static_cast<double>(cell_v);
  const std::uint64_t at = seed + static_cast<std::uint64_t>(cell_u) * kAlongU +
                           static_cast<std::uint64_t>(cell_v) * kAlongV;
  const auto corner = [](std::uint64_t key, double dx, double dy) {
    const Eigen::Vector2d& g = kDirections[((key ^ (key >> 29U)) * 0xbf58476d1ce4e5b9ULL) >> 60U];
    return g.x() * dx + g.y() * dy;
  };
  const double a = fade(x);
  const double b = fade(y);
  const double low = mix(corner(at, x, y), corner(at + kAlongU, x - 1.0, y), a);
  const double high =
      mix(corner(at + kAlongV, x, y - 1.0), corner(at + kAlongU + kAlongV, x - 1.0, y - 1.0), a);
  return 1.4 * mix(low, high, b);
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
  const double low = mix(value(0, 0), value(1, 0), u.second_share);
  const double high = mix(value(0, 1), value(1, 1), u.second_share);
  return contrast * mix(low, high, v.second_share);
}

double pulse_coverage(double x, double duty, double width) {
  const auto integral = [duty](double end) {
    const auto whole = static_cast<double>(floor_of(end));
    return whole * duty + std::min(end - whole, duty);
  };
  if (width <= 1e-9) return x - static_cast<double>(floor_of(x)) < duty ? 1.0 : 0.0;
  return (integral(x + width / 2.0) - integral(x - width / 2.0)) / width;
}

double step_coverage(double x, double edge, double width) {
  if (width <= 1e-9) return x >= edge ? 1.0 : 0.0;
  return std::clamp((x - edge) / width + 0.5, 0.0, 1.0);
}

}  // namespace sparsight::synthetic
