#include "slam/tracking/patch_set.h"

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "slam/image/interpolation.h"

namespace sparsight {
namespace {

struct Entry {
  Eigen::Vector3f p_camera = Eigen::Vector3f::UnitZ();
  float intensity = 0.0F;
  float weight = 0.0F;
};

// Grey value, and the weight of its gradient.
void look(const GreyImage& image, float u, float v, double gradient_weight_constant, Entry& entry) {
  if (gradient_weight_constant <= 0.0) {
    entry.intensity = sample_value(image, u, v);
    entry.weight = 1.0F;
    return;
  }
  const ImageSample s = sample(image, u, v);
  const auto c2 = static_cast<float>(gradient_weight_constant * gradient_weight_constant);
  entry.intensity = s.value;
  entry.weight = c2 / (c2 + s.du * s.du + s.dv * s.dv);
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

void put(PatchSet& set, std::size_t at, const Entry& entry) {
  set.x[at] = entry.p_camera.x();
  set.y[at] = entry.p_camera.y();
  set.z[at] = entry.p_camera.z();
  set.intensity[at] = entry.intensity;
  set.weight[at] = entry.weight;
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

// Normalised coordinates of a pixel beside the centre: by the derivative there, and a step of
// Newton's method with the same, which leaves less than a thousandth of a pixel.
std::optional<Eigen::Vector2d> ray_beside(const Centre& centre, const CameraModel& camera,
                                          const Eigen::Vector2d& offset) {
  const Eigen::Vector2d near = centre.normalized + centre.d_normalized_d_pixel * offset;
  Eigen::Vector2d pixel;
  if (!camera.project(near.homogeneous(), pixel)) return std::nullopt;
  return near - centre.d_normalized_d_pixel * (pixel - centre.pixel - offset);
}

// The pattern pixel's own point: on its ray, at the depth of the surface there.
Entry entry_at(const GreyImage& image, const CameraModel& camera, const SelectedPoint& point,
               const Centre& centre, const Eigen::Vector2d& offset, double fine_pixels_per_pixel,
               double gradient_weight_constant) {
  Entry entry;
  const float inverse_depth =
      1.0F / point.p_camera.z() +
      point.inverse_depth_slope.dot((fine_pixels_per_pixel * offset).cast<float>());
  const Eigen::Vector2d pixel = centre.pixel + offset;
  const auto u = static_cast<float>(pixel.x());
  const auto v = static_cast<float>(pixel.y());
  if (!(inverse_depth > 0.0F) || !can_sample(image.width, image.height, u, v)) return entry;
  const std::optional<Eigen::Vector2d> ray = ray_beside(centre, camera, offset);
  if (!ray) return entry;
  entry.p_camera = ray->homogeneous().cast<float>() / inverse_depth;
  look(image, u, v, gradient_weight_constant, entry);
  entry.weight *= point.weight;
  return entry;
}

}  // namespace

PatchSet make_patches(const ImagePyramid& pyramid, int level, const CameraModel& camera,
                      const std::vector<SelectedPoint>& points, double gradient_weight_constant) {
  const CameraModel level_camera = camera.at_level(level);
  const double fine_pixels_per_pixel = std::exp2(level);
  PatchSet set = empty_set(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<Centre> centre = centre_of(points[i], level_camera);
    if (!centre) continue;
    for (std::size_t k = 0; k < kPatternSize; ++k) {
      const Eigen::Vector2d offset(kPattern[k].u, kPattern[k].v);
      put(set, i * kPatternSize + k,
          entry_at(pyramid.level(level), level_camera, points[i], *centre, offset,
                   fine_pixels_per_pixel, gradient_weight_constant));
    }
  }
  return set;
}

}  // namespace sparsight
