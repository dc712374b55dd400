#include "tests/synthetic/material.h"

#include <algorithm>
#include <cmath>

#include "tests/synthetic/random.h"

namespace sparsight::synthetic {
namespace {

double value(const Grain& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  return layer.amplitude * layer.noise(uv, footprint);
}

double value(const Blotches& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  const double softness = 0.04 + 1.5 * footprint.largest() / layer.noise.longest;
  return layer.amplitude * std::clamp(layer.noise(uv, footprint) / softness, -1.0, 1.0) /
         std::max(1.0, softness);
}

double value(const Patches& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  double sum = 0.0;
  double scale = 1.0;
  for (int octave = 0; octave < layer.octaves; ++octave) {
    sum += scale * cell_noise(uv, scale * layer.size, footprint,
                              layer.seed + static_cast<std::uint64_t>(octave));
    scale /= 2.0;
  }
  return layer.amplitude * sum;
}

double line_share(double x, double period, double width, double footprint) {
  return period <= 0.0 ? 0.0 : pulse_coverage(x / period, width / period, footprint / period);
}

double value(const Lines& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  const double along = line_share(uv.x(), layer.period.x(), layer.width, footprint.u);
  const double across = line_share(uv.y(), layer.period.y(), layer.width, footprint.v);
  return layer.tone * (along + across - along * across);
}

double value(const Panels& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  const Eigen::Vector2d cell = (uv - layer.offset).cwiseQuotient(layer.period);
  const Eigen::Vector2d duty = layer.size.cwiseQuotient(layer.period);
  const double share = pulse_coverage(cell.x(), duty.x(), footprint.u / layer.period.x()) *
                       pulse_coverage(cell.y(), duty.y(), footprint.v / layer.period.y());
  if (share <= 0.0) return 0.0;
  const double vary = cell_noise(uv - layer.offset, layer.period, footprint, layer.seed);
  return share * (layer.tone + layer.variation * vary);
}

double value(const Band& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  return layer.tone * (step_coverage(uv.y(), layer.v_low, footprint.v) -
                       step_coverage(uv.y(), layer.v_high, footprint.v));
}

double value(const RoadMarks& layer, const Eigen::Vector2d& uv, const Footprint& footprint) {
  const double slope = layer.bend.slope(uv.x());
  const double across = (uv.y() - layer.bend.offset(uv.x())) / std::sqrt(1.0 + slope * slope);
  const double verge = step_coverage(std::abs(across), layer.half_width, footprint.v);
  double sum = verge * layer.verge_tone;
  if (verge > 0.0 && layer.verge_grain > 0.0) {
    sum += verge * layer.verge_grain * OctaveNoise{8.0, 0.03, 0.85, 77}(uv, footprint);
  }
  for (const RoadMarks::Line& line : layer.lines) {
    const double low = line.offset - line.width / 2.0;
    double share = step_coverage(across, low, footprint.v) -
                   step_coverage(across, low + line.width, footprint.v);
    if (share > 0.0 && line.period > 0.0) {
      share *= pulse_coverage(uv.x() / line.period, line.duty, footprint.u / line.period);
    }
    sum += share * layer.line_tone;
  }
  return sum;
}

}  // namespace

double RoadBend::offset(double u) const {
  return amplitude * std::sin(2.0 * M_PI * u / wavelength);
}

double RoadBend::slope(double u) const {
  return amplitude * 2.0 * M_PI / wavelength * std::cos(2.0 * M_PI * u / wavelength);
}

double Material::grey(const Eigen::Vector2d& uv, const Footprint& footprint) const {
  double sum = base;
  for (const Layer& layer : layers) {
    sum += std::visit([&](const auto& concrete) { return value(concrete, uv, footprint); }, layer);
  }
  return std::clamp(sum, 2.0, 250.0);
}

}  // namespace sparsight::synthetic
