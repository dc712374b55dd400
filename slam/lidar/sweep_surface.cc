#include "slam/lidar/sweep_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "slam/geometry/arctangent.h"
#include "slam/lidar/plane_fit.h"
#include "slam/lidar/sweep_rows.h"
#include "slam/points/sweep_motion.h"

namespace sparsight {
namespace {

constexpr int kColumns = 180;  // of 2 degrees, as the bins of Sec. IV-B4
constexpr int kElevations = 360;
constexpr std::size_t kEnoughReturns = 24000;
constexpr double kFewestReturns = 6.0;
constexpr double kThickest = 0.2;          // metres, rms: hedges are planes, trees are not
constexpr double kWidthOfThickness = 3.0;  // a plane is wider than it is thick, both ways
constexpr double kLeastThickness = 0.02;

int column_of(const Eigen::Vector3f& p) {
  const float turn = arctangent(p.y(), p.x()) * static_cast<float>(0.5 / M_PI) + 0.5F;
  return std::min(kColumns - 1, static_cast<int>(turn * kColumns));
}

// The plane of returns; no normal if they do not lie on one.
SweepSurface::Plane plane_through(const PointMoments& returns) {
  if (returns.count() < kFewestReturns) return {};
  const auto axes = plane_axes(returns.covariance(), kThickest * kThickest);
  if (!axes) return {};
  const double thickness = axes->extent.x();
  if (axes->extent.y() < kWidthOfThickness * std::max(thickness, kLeastThickness)) return {};
  return {.centre = returns.mean().cast<float>(),
          .normal = axes->normal.cast<float>(),
          .thickness_m = static_cast<float>(thickness),
          .reach_m = static_cast<float>(2.0 * axes->extent.z())};
}

// Rows and columns around a bin: all, or at an edge of what is there one side of it, or a corner.
struct Block {
  int first_row, last_row, first_column, last_column;
};
constexpr std::array<Block, 7> kBlocks{{{-1, 1, -1, 1},
                                        {-1, 0, -1, 1},
                                        {0, 1, -1, 1},
                                        {-1, 0, -1, 0},
                                        {-1, 0, 0, 1},
                                        {0, 1, -1, 0},
                                        {0, 1, 0, 1}}};

class Bins {
 public:
  Bins(std::span<const SweepPoint> points, const SweepRows& rows)
      : rows_(rows.count()), bins_(static_cast<std::size_t>(rows_) * kStride) {
    for (const SweepPoint& point : points) {
      bins_[index(rows.of_ring(point.ring), column_of(point.p_lidar))].add(point.p_lidar);
    }
    // A row goes all around: each end has the other's neighbour beside it.
    for (int row = 0; row < rows_; ++row) {
      bins_[index(row, -1)] = bins_[index(row, kColumns - 1)];
      bins_[index(row, kColumns)] = bins_[index(row, 0)];
    }
  }

  SweepSurface::Plane plane(int row, int column) const {
    if (bins_[index(row, column)].count() == 0.0) return {};
    for (const Block& block : kBlocks) {
      SweepSurface::Plane plane = plane_through(moments(block, row, column));
      if (!plane.normal.isZero()) return plane;
    }
    return {};
  }

 private:
  static constexpr std::size_t kStride = kColumns + 2;

  static std::size_t index(int row, int column) {
    return static_cast<std::size_t>(row) * kStride + static_cast<std::size_t>(column + 1);
  }

  PointMoments moments(const Block& block, int row, int column) const {
    PointMoments sum;
    const int last = std::min(rows_ - 1, row + block.last_row);
    for (int r = std::max(0, row + block.first_row); r <= last; ++r) {
      for (int c = column + block.first_column; c <= column + block.last_column; ++c) {
        sum.add(bins_[index(r, c)]);
      }
    }
    return sum;
  }

  int rows_;
  std::vector<PointMoments> bins_;
};

}  // namespace

SweepSurface::SweepSurface(std::span<const SweepPoint> points) {
  if (points.empty()) return;
  const SweepRows rows(points);
  const Bins bins(points, rows);
  planes_.reserve(static_cast<std::size_t>(rows.count()) * kColumns);
  for (int row = 0; row < rows.count(); ++row) {
    for (int column = 0; column < kColumns; ++column) planes_.push_back(bins.plane(row, column));
  }
  for (int i = 0; i < kElevations; ++i) {
    row_at_.push_back(static_cast<std::int16_t>(rows.at((i + 0.5) * M_PI / kElevations - M_PI_2)));
  }
}

const SweepSurface::Plane* SweepSurface::at(const Eigen::Vector3f& p_lidar) const {
  if (planes_.empty()) return nullptr;
  const auto up = static_cast<float>(kElevations / M_PI) * elevation_rad(p_lidar);
  const int elevation = std::clamp(static_cast<int>(up) + kElevations / 2, 0, kElevations - 1);
  const int row = row_at_[static_cast<std::size_t>(elevation)];
  if (row < 0) return nullptr;
  const Plane& plane = planes_[static_cast<std::size_t>(row * kColumns + column_of(p_lidar))];
  return plane.normal.isZero() ? nullptr : &plane;
}

SweepSurface surface_of(const Sweep& sweep, const Eigen::Isometry3d& T_camera_lidar,
                        const MotionAround& motion) {
  const Eigen::Isometry3d T_lidar_camera = T_camera_lidar.inverse();
  const SweepMotion at_exposure(firing_span(sweep), [&](double seconds) -> Eigen::Isometry3d {
    return T_lidar_camera * motion(seconds) * T_camera_lidar;
  });
  const std::size_t stride = 1 + sweep.returns.size() / kEnoughReturns;
  std::vector<SweepPoint> points;
  points.reserve(sweep.returns.size() / stride + 1);
  for (std::size_t i = 0; i < sweep.returns.size(); i += stride) {
    const LidarReturn& r = sweep.returns[i];
    const Eigen::Vector3f p = at_exposure.moved(r);
    if (p.allFinite()) points.push_back({.p_lidar = p, .ring = r.ring});
  }
  return SweepSurface(points);
}

}  // namespace sparsight
