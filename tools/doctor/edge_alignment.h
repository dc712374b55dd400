#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "hal/frame_source.h"
#include "tools/doctor/depth_edges.h"

namespace sparsight {

struct EdgeAlignmentConfig {
  DepthEdgeConfig edges;
  std::size_t most_edges = 50'000;  // with more, nothing is learned
  double most_gradient = 4.0;       // of the image's mean; a stronger edge counts no more
  // The calibration is turned about the camera's three axes, by all of these about two of them.
  double step_deg = 0.25;
  int steps = 8;  // to either side
  // What is nearer to the given calibration is neither better nor worse.
  double least_turn_deg = 0.4;
  double most_turn_deg = 1.3;
};

struct EdgeAlignmentReport {
  std::size_t frames = 0;
  std::size_t edges = 0;
  // How strong the image is at the depth edges, in mean gradients of the image: as calibrated, and
  // with the calibration turned a little, in the mean.
  double gradient = 0.0;
  double turned_gradient = 0.0;
  double share_worse = 0.0;  // of the turned ones
  double best_gradient = 0.0;
  // The turn at which the images fit best, about the camera's axes: of x what the LiDAR sees goes
  // upwards in the image, of y to the right, of z clockwise.
  Eigen::Vector3d best_turn_deg = Eigen::Vector3d::Zero();
};

// How well what the LiDAR sees as an edge meets the edges of the images (Levinson and Thrun 2013,
// Sec. III: a calibration is right when small changes to it are worse). Thread-bound.
class EdgeAlignment {
 public:
  explicit EdgeAlignment(const RigCalibration& rig, const EdgeAlignmentConfig& config = {});

  void add(const SynchronizedFrame& frame);
  EdgeAlignmentReport report() const;
  // The one with the most depth edges, for the picture.
  const std::optional<SynchronizedFrame>& best_frame() const { return best_frame_; }

 private:
  struct Turn {
    Eigen::Vector3d deg;
    Eigen::Matrix3d R;
    double sum = 0.0;
  };

  RigCalibration rig_;
  EdgeAlignmentConfig config_;
  std::vector<Turn> turns_;  // the first is none
  double weight_ = 0.0;
  std::size_t frames_ = 0;
  std::size_t edges_ = 0;
  std::size_t most_edges_ = 0;
  std::optional<SynchronizedFrame> best_frame_;
};

}  // namespace sparsight
