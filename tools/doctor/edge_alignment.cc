#include "tools/doctor/edge_alignment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "slam/geometry/camera_model.h"

namespace sparsight {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr int kBorder = 3;  // pixels without a gradient

// Gradient magnitudes, in units of their mean.
class GradientImage {
 public:
  GradientImage(const GreyImage& grey, double most) : width_(grey.width), height_(grey.height) {
    values_.resize(grey.pixels.size());
    double sum = 0.0;
    for (int v = 2; v + 2 < height_; ++v) {
      for (int u = 2; u + 2 < width_; ++u) sum += values_[index(u, v)] = magnitude(grey, u, v);
    }
    const double mean = sum / static_cast<double>(values_.size());
    const auto scale = static_cast<float>(mean > 0.0 ? 1.0 / mean : 0.0);
    for (float& value : values_) value = std::min(scale * value, static_cast<float>(most));
  }

  double at(const Eigen::Vector2d& pixel) const {
    const int u = static_cast<int>(pixel.x());
    const int v = static_cast<int>(pixel.y());
    const double x = pixel.x() - u;
    const double y = pixel.y() - v;
    return (1 - y) * ((1 - x) * values_[index(u, v)] + x * values_[index(u + 1, v)]) +
           y * ((1 - x) * values_[index(u, v + 1)] + x * values_[index(u + 1, v + 1)]);
  }

 private:
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }
  // Sums of three by two pixels on either side, two apart: single noisy pixels count little.
  static float magnitude(const GreyImage& grey, int u, int v) {
    int x = 0;
    int y = 0;
    for (int k = -1; k <= 1; ++k) {
      x += grey.at(u + 1, v + k) + grey.at(u + 2, v + k) - grey.at(u - 1, v + k) -
           grey.at(u - 2, v + k);
      y += grey.at(u + k, v + 1) + grey.at(u + k, v + 2) - grey.at(u + k, v - 1) -
           grey.at(u + k, v - 2);
    }
    return std::hypot(static_cast<float>(x), static_cast<float>(y));
  }

  int width_;
  int height_;
  std::vector<float> values_;
};

Eigen::Matrix3d rotation_of(const Eigen::Vector3d& deg) {
  const double angle = deg.norm() * kDegree;
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, deg.normalized()).toRotationMatrix();
}

}  // namespace

EdgeAlignment::EdgeAlignment(const RigCalibration& rig, const EdgeAlignmentConfig& config)
    : rig_(rig), config_(config) {
  const auto add_turn = [&](const Eigen::Vector3d& deg) {
    turns_.push_back({.deg = deg, .R = rotation_of(deg)});
  };
  add_turn(Eigen::Vector3d::Zero());
  for (int x = -config_.steps; x <= config_.steps; ++x) {
    for (int y = -config_.steps; y <= config_.steps; ++y) {
      if (x != 0 || y != 0) add_turn(config_.step_deg * Eigen::Vector3d(x, y, 0.0));
    }
  }
  for (int z = -config_.steps; z <= config_.steps; ++z) {
    if (z != 0) add_turn(config_.step_deg * Eigen::Vector3d(0.0, 0.0, z));
  }
}

void EdgeAlignment::add(const SynchronizedFrame& frame) {
  if (frame.grey.empty() || frame.sweep.returns.empty() || edges_ >= config_.most_edges) return;
  const std::vector<DepthEdge> edges = depth_edges(frame.sweep, rig_, config_.edges);
  const CameraModel camera(rig_.camera);
  const GradientImage gradient(frame.grey, config_.most_gradient);
  std::vector<double> values(turns_.size());
  std::size_t seen = 0;
  for (const DepthEdge& edge : edges) {
    // An edge counts if it stays within the image wherever it is turned.
    Eigen::Vector2d pixel;
    bool inside = true;
    for (std::size_t i = 0; i < turns_.size() && inside; ++i) {
      inside =
          camera.project(turns_[i].R * edge.p_camera, pixel) && camera.contains(pixel, kBorder);
      if (inside) values[i] = gradient.at(pixel);
    }
    if (!inside) continue;
    ++seen;
    weight_ += edge.weight;
    for (std::size_t i = 0; i < turns_.size(); ++i) turns_[i].sum += edge.weight * values[i];
  }
  if (seen == 0) return;
  ++frames_;
  edges_ += seen;
  if (seen <= most_edges_) return;
  most_edges_ = seen;
  best_frame_ = frame;
}

EdgeAlignmentReport EdgeAlignment::report() const {
  EdgeAlignmentReport report{.frames = frames_, .edges = edges_};
  if (weight_ == 0.0) return report;
  const double given = turns_.front().sum;
  double sum = 0.0;
  int worse = 0;
  int count = 0;
  const Turn* best = &turns_.front();
  for (const Turn& turn : turns_) {
    if (turn.sum > best->sum) best = &turn;
    const double angle = turn.deg.norm();
    if (angle < config_.least_turn_deg || angle > config_.most_turn_deg) continue;
    ++count;
    sum += turn.sum;
    worse += turn.sum < given ? 1 : 0;
  }
  report.gradient = given / weight_;
  report.turned_gradient = sum / count / weight_;
  report.share_worse = static_cast<double>(worse) / count;
  report.best_gradient = best->sum / weight_;
  report.best_turn_deg = best->deg;
  return report;
}

}  // namespace sparsight
