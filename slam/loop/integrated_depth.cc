#include "slam/loop/integrated_depth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/points/visibility.h"

namespace sparsight {
namespace {

constexpr float kKeptCellPx = 2.0F;    // one return in each
constexpr float kLookupCellPx = 5.0F;  // and the reach of a lookup
constexpr float kDepthAgreement = 0.05F;

std::size_t cell_of(const Eigen::Vector2f& pixel, float size_px, int columns, int rows) {
  const int column = std::clamp(static_cast<int>((pixel.x() + 0.5F) / size_px), 0, columns - 1);
  const int row = std::clamp(static_cast<int>((pixel.y() + 0.5F) / size_px), 0, rows - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(column);
}

int cells_across(int pixels, float size_px) {
  return static_cast<int>(std::ceil(static_cast<float>(pixels) / size_px));
}

}  // namespace

std::vector<CameraReturn> integrated_depth(std::span<const NearbyCloud> clouds,
                                           const CameraModel& camera) {
  const int columns = cells_across(camera.intrinsics().width, kKeptCellPx);
  const int rows = cells_across(camera.intrinsics().height, kKeptCellPx);
  std::vector<CameraReturn> nearest(static_cast<std::size_t>(columns) *
                                    static_cast<std::size_t>(rows));
  std::vector<bool> taken(nearest.size(), false);
  for (const NearbyCloud& nearby : clouds) {
    const Eigen::Isometry3f T = nearby.T_view_nearby.cast<float>();
    for (const Eigen::Vector3f& p : nearby.cloud) {
      const Eigen::Vector3f p_camera = T * p;
      Eigen::Vector2d pixel;
      if (!camera.project(p_camera.cast<double>(), pixel) || !camera.contains(pixel, 0.0)) continue;
      const Eigen::Vector2f at = pixel.cast<float>();
      const std::size_t cell = cell_of(at, kKeptCellPx, columns, rows);
      if (taken[cell] && nearest[cell].p_camera.z() <= p_camera.z()) continue;
      nearest[cell] = {.p_camera = p_camera, .pixel = at};
      taken[cell] = true;
    }
  }
  std::vector<CameraReturn> kept;
  for (std::size_t cell = 0; cell < nearest.size(); ++cell) {
    if (taken[cell]) kept.push_back(nearest[cell]);
  }
  const std::vector<bool> hidden = hidden_from_camera(kept, camera);
  std::vector<CameraReturn> visible;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!hidden[i]) visible.push_back(kept[i]);
  }
  return visible;
}

DepthLookup::DepthLookup(const std::vector<CameraReturn>& returns, const CameraModel& camera)
    : returns_(returns),
      camera_(camera),
      columns_(cells_across(camera.intrinsics().width, kLookupCellPx)),
      rows_(cells_across(camera.intrinsics().height, kLookupCellPx)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  for (std::size_t i = 0; i < returns.size(); ++i) {
    cells_[cell_of(returns[i].pixel, kLookupCellPx, columns_, rows_)].push_back(
        static_cast<std::uint32_t>(i));
  }
}

std::optional<Eigen::Vector3d> DepthLookup::at(const Eigen::Vector2f& pixel) const {
  const int column = static_cast<int>((pixel.x() + 0.5F) / kLookupCellPx);
  const int row = static_cast<int>((pixel.y() + 0.5F) / kLookupCellPx);
  double weights = 0.0;
  double inverse_depth = 0.0;
  float lowest = 0.0F;
  float highest = 0.0F;
  for (int v = std::max(row - 1, 0); v <= std::min(row + 1, rows_ - 1); ++v) {
    for (int u = std::max(column - 1, 0); u <= std::min(column + 1, columns_ - 1); ++u) {
      for (const std::uint32_t i : cells_[static_cast<std::size_t>(v * columns_ + u)]) {
        const CameraReturn& r = returns_[i];
        const float distance = (r.pixel - pixel).norm();
        if (distance > kLookupCellPx) continue;
        const float z = r.p_camera.z();
        lowest = weights == 0.0 ? z : std::min(lowest, z);
        highest = std::max(highest, z);
        const double weight = 1.0 / (0.25 + static_cast<double>(distance));
        weights += weight;
        inverse_depth += weight / static_cast<double>(z);
      }
    }
  }
  if (weights == 0.0 || highest - lowest > kDepthAgreement * lowest) return std::nullopt;
  return camera_.unproject(pixel.cast<double>()) * (weights / inverse_depth);
}

}  // namespace sparsight
