#include "slam/points/point_selection.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include "slam/geometry/arctangent.h"
#include "slam/points/surface_slope.h"
#include "slam/points/visibility.h"

namespace sparsight {
namespace {

constexpr double kPatchBorderPx = 4.0;  // the pattern reaches 2 px, its interpolation 2 more

struct Candidate {
  std::size_t index = 0;
  int gradient2 = -1;  // none yet
};

// Squared central difference at the nearest pixel, times four.
int gradient2_at(const GreyImage& image, const Eigen::Vector2f& pixel) {
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  const int du = image.at(u + 1, v) - image.at(u - 1, v);
  const int dv = image.at(u, v + 1) - image.at(u, v - 1);
  return du * du + dv * dv;
}

// Azimuth and elevation bins of the front half of the sphere.
class SphereBins {
 public:
  explicit SphereBins(double bin_deg)
      : bin_rad_(bin_deg * M_PI / 180.0),
        across_(static_cast<int>(std::ceil(M_PI / bin_rad_)) + 1) {}

  std::size_t of(const Eigen::Vector3f& p) const {
    const double azimuth = arctangent(p.x(), p.z()) + M_PI_2;
    const double elevation = arctangent(p.y(), std::sqrt(p.x() * p.x() + p.z() * p.z())) + M_PI_2;
    return static_cast<std::size_t>(static_cast<int>(elevation / bin_rad_) * across_ +
                                    static_cast<int>(azimuth / bin_rad_));
  }
  std::size_t count() const { return static_cast<std::size_t>(across_) * across_; }

 private:
  double bin_rad_;
  int across_;
};

}  // namespace

std::vector<SelectedPoint> select_points(const std::vector<CameraReturn>& returns,
                                         const std::vector<bool>& hidden, const GreyImage& image,
                                         const CameraModel& camera,
                                         const PointSelectionConfig& config) {
  std::vector<bool> rejected(returns.size(), false);
  if (config.reject_depth_edges) rejected = on_depth_edge(returns);
  if (config.reject_hidden) {
    for (std::size_t i = 0; i < hidden.size(); ++i) rejected[i] = rejected[i] || hidden[i];
  }

  const SphereBins bins(config.bin_deg);
  std::vector<Candidate> best(bins.count());
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const CameraReturn& r = returns[i];
    const double depth = r.p_camera.z();
    if (rejected[i] || depth < config.min_depth_m || depth > config.max_depth_m) continue;
    if (!camera.contains(r.pixel.cast<double>(), kPatchBorderPx)) continue;
    const int gradient2 = gradient2_at(image, r.pixel);
    Candidate& candidate = best[bins.of(r.p_camera)];
    if (gradient2 > candidate.gradient2) candidate = {.index = i, .gradient2 = gradient2};
  }

  std::optional<SurfaceSlopes> slopes;
  if (config.surface_slope) slopes.emplace(returns, camera);
  std::vector<SelectedPoint> points;
  for (const Candidate& candidate : best) {
    if (candidate.gradient2 < 0) continue;
    const CameraReturn& r = returns[candidate.index];
    points.push_back({.p_camera = r.p_camera, .pixel = r.pixel});
    if (slopes) points.back().inverse_depth_slope = slopes->at(candidate.index);
  }
  return points;
}

}  // namespace sparsight
