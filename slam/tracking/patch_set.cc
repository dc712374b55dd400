#include "slam/tracking/patch_set.h"

#include <cmath>

#include "slam/image/interpolation.h"

namespace sparsight {
namespace {

struct Entry {
  Eigen::Vector3f p_camera = Eigen::Vector3f::UnitZ();
  float intensity = 0.0F;
  float weight = 0.0F;
};

float gradient_weight(const ImageSample& s, double constant) {
  if (constant <= 0.0) return 1.0F;
  const auto c2 = static_cast<float>(constant * constant);
  return c2 / (c2 + s.du * s.du + s.dv * s.dv);
}

void append(PatchSet& set, const Entry& entry) {
  set.x.push_back(entry.p_camera.x());
  set.y.push_back(entry.p_camera.y());
  set.z.push_back(entry.p_camera.z());
  set.intensity.push_back(entry.intensity);
  set.weight.push_back(entry.weight);
}

// The pattern pixel's own point: on its ray, at the depth of the surface there.
Entry entry_at(const GreyImage& image, const CameraModel& camera, const SelectedPoint& point,
               const Eigen::Vector2d& pixel, const Eigen::Vector2d& offset_fine,
               double gradient_weight_constant) {
  Entry entry;
  const float inverse_depth =
      1.0F / point.p_camera.z() + point.inverse_depth_slope.dot(offset_fine.cast<float>());
  const auto u = static_cast<float>(pixel.x());
  const auto v = static_cast<float>(pixel.y());
  if (!(inverse_depth > 0.0F) || !can_sample(image.width, image.height, u, v)) return entry;
  const ImageSample s = sample(image, u, v);
  entry.p_camera = camera.unproject(pixel).cast<float>() / inverse_depth;
  entry.intensity = s.value;
  entry.weight = gradient_weight(s, gradient_weight_constant);
  return entry;
}

}  // namespace

PatchSet make_patches(const ImagePyramid& pyramid, int level, const CameraModel& camera,
                      const std::vector<SelectedPoint>& points, double gradient_weight_constant) {
  const CameraModel level_camera = camera.at_level(level);
  const double fine_pixels_per_pixel = std::exp2(level);
  PatchSet set;
  set.patches = points.size();
  for (const SelectedPoint& point : points) {
    Eigen::Vector2d centre;
    const bool projects = level_camera.project(point.p_camera.cast<double>(), centre);
    for (const PatternOffset& pattern : kPattern) {
      const Eigen::Vector2d offset(pattern.u, pattern.v);
      append(set, projects ? entry_at(pyramid.level(level), level_camera, point, centre + offset,
                                      fine_pixels_per_pixel * offset, gradient_weight_constant)
                           : Entry{});
    }
  }
  while (set.entries() % PatchSet::kBlock != 0) append(set, Entry{});
  return set;
}

}  // namespace sparsight
