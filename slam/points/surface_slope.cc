#include "slam/points/surface_slope.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sparsight {
namespace {

constexpr double kReachRad = 1.0 * M_PI / 180.0;
constexpr float kSameSurface = 0.1F;  // largest difference in inverse depth, as a share of it
constexpr int kRobustIterations = 3;

struct Neighbor {
  Eigen::Vector2f offset;    // pixels
  float inverse_depth_step;  // 1/m
};

// Weighted least squares; the ridge keeps a direction without neighbours at zero.
Eigen::Vector2f fit(const std::vector<Neighbor>& neighbors, float tolerance) {
  Eigen::Vector2f slope = Eigen::Vector2f::Zero();
  for (int i = 0; i < kRobustIterations; ++i) {
    Eigen::Matrix2f A = 4.0F * Eigen::Matrix2f::Identity();
    Eigen::Vector2f c = Eigen::Vector2f::Zero();
    for (const Neighbor& n : neighbors) {
      const float error = (n.inverse_depth_step - slope.dot(n.offset)) / tolerance;
      const float weight = i == 0 ? 1.0F : 1.0F / (1.0F + error * error);
      A += weight * n.offset * n.offset.transpose();
      c += weight * n.inverse_depth_step * n.offset;
    }
    slope = A.inverse() * c;
  }
  return slope;
}

}  // namespace

SurfaceSlopes::SurfaceSlopes(const std::vector<CameraReturn>& returns, const CameraModel& camera)
    : returns_(returns),
      cell_px_(static_cast<float>(std::max(1.0, camera.intrinsics().fx * kReachRad))),
      columns_(static_cast<int>(static_cast<float>(camera.intrinsics().width) / cell_px_) + 3),
      rows_(static_cast<int>(static_cast<float>(camera.intrinsics().height) / cell_px_) + 3) {
  first_in_cell_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const CameraReturn& r : returns) ++first_in_cell_[cell_of(r.pixel) + 1];
  for (std::size_t i = 1; i < first_in_cell_.size(); ++i)
    first_in_cell_[i] += first_in_cell_[i - 1];
  std::vector<std::size_t> next = first_in_cell_;
  by_cell_.resize(returns.size());
  for (std::size_t i = 0; i < returns.size(); ++i) by_cell_[next[cell_of(returns[i].pixel)]++] = i;
}

std::size_t SurfaceSlopes::cell_of(const Eigen::Vector2f& pixel) const {
  const int column = 1 + static_cast<int>(pixel.x() / cell_px_);
  const int row = 1 + static_cast<int>(pixel.y() / cell_px_);
  return static_cast<std::size_t>(row * columns_ + column);
}

Eigen::Vector2f SurfaceSlopes::at(std::size_t index) const {
  const CameraReturn& centre = returns_[index];
  const float inverse_depth = 1.0F / centre.p_camera.z();
  const std::size_t cell = cell_of(centre.pixel);
  std::vector<Neighbor> neighbors;
  for (const int row : {-columns_, 0, columns_}) {
    const std::size_t begin = first_in_cell_[cell + static_cast<std::size_t>(row) - 1];
    const std::size_t end = first_in_cell_[cell + static_cast<std::size_t>(row) + 2];
    for (std::size_t i = begin; i < end; ++i) {
      const CameraReturn& other = returns_[by_cell_[i]];
      const Eigen::Vector2f offset = other.pixel - centre.pixel;
      const float step = 1.0F / other.p_camera.z() - inverse_depth;
      if (offset.squaredNorm() > cell_px_ * cell_px_) continue;
      if (std::abs(step) > kSameSurface * inverse_depth) continue;
      neighbors.push_back({offset, step});
    }
  }
  return fit(neighbors, 0.02F * inverse_depth);
}

}  // namespace sparsight
