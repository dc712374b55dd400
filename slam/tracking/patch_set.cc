#include "slam/tracking/patch_set.h"

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "slam/image/interpolation.h"

namespace sparsight {
namespace {

// One element per pixel of the pattern.
using Octet = Eigen::Array<double, static_cast<int>(kPatternSize), 1>;
using FloatOctet = Eigen::Array<float, static_cast<int>(kPatternSize), 1>;

Octet offsets(int PatternOffset::*along) {
  Octet result;
  for (std::size_t k = 0; k < kPatternSize; ++k) {
    result(static_cast<Eigen::Index>(k)) = kPattern[k].*along;
  }
  return result;
}

// Of entries that count for nothing.
PatchSet empty_set(std::size_t patches) {
  const std::size_t blocks = (patches * kPatternSize + PatchSet::kBlock - 1) / PatchSet::kBlock;
  const std::size_t entries = blocks * PatchSet::kBlock;
  PatchSet set;
  set.patches = patches;
  for (std::vector<float>* column : {&set.x, &set.y, &set.intensity, &set.weight}) {
    column->assign(entries, 0.0F);
  }
  set.z.assign(entries, 1.0F);
  return set;
}

// A point at one level: where the pattern is centred, and how rays turn with pixels there.
struct Centre {
  Eigen::Vector2d pixel;
  Eigen::Vector2d normalized;
  Eigen::Matrix2d d_normalized_d_pixel;
};

std::optional<Centre> centre_of(const SelectedPoint& point, const CameraModel& camera) {
  const Eigen::Vector3d p = point.p_camera.cast<double>();
  Centre centre;
  if (!camera.project(p, centre.pixel)) return std::nullopt;
  centre.normalized = p.head<2>() / p.z();
  centre.d_normalized_d_pixel = camera.d_pixel_d_normalized(centre.normalized).inverse();
  return centre;
}

// The pattern around a point at one level: pixels, and the normalised coordinates of their rays.
struct Pattern {
  Octet u, v;
  Octet x, y;
};

// Rays by the derivative at the centre, and a step of Newton's method with the same, which leaves
// less than a thousandth of a pixel.
Pattern pattern_around(const Centre& centre, const CameraModel& camera) {
  static const Octet kU = offsets(&PatternOffset::u);
  static const Octet kV = offsets(&PatternOffset::v);
  const Eigen::Matrix2d& J = centre.d_normalized_d_pixel;
  Pattern p{.u = centre.pixel.x() + kU,
            .v = centre.pixel.y() + kV,
            .x = centre.normalized.x() + J(0, 0) * kU + J(0, 1) * kV,
            .y = centre.normalized.y() + J(1, 0) * kU + J(1, 1) * kV};
  const CameraIntrinsics& c = camera.intrinsics();
  if (!c.distorted()) return p;
  Octet u;
  Octet v;
  camera.distort(p.x, p.y, u, v);
  u = c.fx * u + c.cx - p.u;
  v = c.fy * v + c.cy - p.v;
  p.x -= J(0, 0) * u + J(0, 1) * v;
  p.y -= J(1, 0) * u + J(1, 1) * v;
  return p;
}

// Each pattern pixel's own point: on its ray, at the depth of the surface there.
void put(PatchSet& set, std::size_t first, const Pattern& pattern,
         const FloatOctet& inverse_depth) {
  const FloatOctet z = (inverse_depth > 0.0F).select(inverse_depth.inverse(), 1.0F);
  Eigen::Map<FloatOctet>(&set.x[first]) = pattern.x.cast<float>() * z;
  Eigen::Map<FloatOctet>(&set.y[first]) = pattern.y.cast<float>() * z;
  Eigen::Map<FloatOctet>(&set.z[first]) = z;
}

// Grey value, and the weight of its gradient.
void look(const GreyImage& image, float u, float v, double gradient_weight_constant,
          float& intensity, float& weight) {
  if (gradient_weight_constant <= 0.0) {
    intensity = sample_value(image, u, v);
    return;
  }
  const ImageSample s = sample(image, u, v);
  const auto c2 = static_cast<float>(gradient_weight_constant * gradient_weight_constant);
  intensity = s.value;
  weight *= c2 / (c2 + s.du * s.du + s.dv * s.dv);
}

}  // namespace

PatchSet make_patches(const ImagePyramid& pyramid, int level, const CameraModel& camera,
                      const std::vector<SelectedPoint>& points, double gradient_weight_constant) {
  const CameraModel level_camera = camera.at_level(level);
  const double fine_pixels_per_pixel = std::exp2(level);
  const GreyImage& image = pyramid.level(level);
  PatchSet set = empty_set(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Centre> centre = centre_of(points[i], level_camera);
    if (!centre) continue;
    const Pattern pattern = pattern_around(*centre, level_camera);
    const Eigen::Vector2f slope =
        static_cast<float>(fine_pixels_per_pixel) * points[i].inverse_depth_slope;
    const FloatOctet inverse_depth = 1.0F / points[i].p_camera.z() +
                                     slope.x() * (pattern.u - centre->pixel.x()).cast<float>() +
                                     slope.y() * (pattern.v - centre->pixel.y()).cast<float>();
    put(set, i * kPatternSize, pattern, inverse_depth);
    for (std::size_t k = 0; k < kPatternSize; ++k) {
      const auto pixel = static_cast<Eigen::Index>(k);
      const auto u = static_cast<float>(pattern.u(pixel));
      const auto v = static_cast<float>(pattern.v(pixel));
      if (!(inverse_depth(pixel) > 0.0F) || !can_sample(image.width, image.height, u, v)) continue;
      const std::size_t entry = i * kPatternSize + k;
      set.weight[entry] = points[i].weight;
      look(image, u, v, gradient_weight_constant, set.intensity[entry], set.weight[entry]);
    }
  }
  return set;
}

}  // namespace sparsight
