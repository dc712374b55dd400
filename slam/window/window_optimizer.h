#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "slam/calibration/self_calibration.h"
#include "slam/keyframe.h"
#include "slam/window/marginalization.h"
#include "slam/window/pair_term.h"

namespace sparsight {

struct WindowConfig {
  int size = 5;  // N_w of Table I
  int max_iterations = 15;
  double convergence_px = 0.01;
  // A pair of keyframes is covisible if this share of the host's points, and at least min_points,
  // project into the target and are found there.
  double min_visible_ratio = 0.15;
  int min_points = 30;
  double min_found_share = 0.3;
};

struct WindowSummary {
  int pairs = 0;
  int iterations = 0;
  double initial_energy = 0.0;
  double final_energy = 0.0;
  bool converged = false;
};

// A keyframe that left, with what the window knew about the next one relative to it.
struct MarginalizedKeyframe {
  std::unique_ptr<Keyframe> keyframe;
  Matrix6d successor_information = Matrix6d::Zero();  // left increment of T_keyframe_successor
};

// The keyframes under optimisation, oldest first: eq. (6) over their poses, with the prior that
// marginalised keyframes left behind. Increments are on the body side, T <- T exp(eta): no lever
// arm to a far origin. The oldest pose is held, as the energy does not depend on where the world
// begins. Thread-bound.
class WindowOptimizer {
 public:
  WindowOptimizer(const CameraModel& camera, const WindowConfig& config,
                  const PhotometryConfig& photometry);

  int size() const { return static_cast<int>(keyframes_.size()); }
  bool full() const { return size() > config_.size; }
  Keyframe& latest() { return *keyframes_.back(); }
  const Keyframe& oldest() const { return *keyframes_.front(); }
  const Keyframe& keyframe(int index) const { return *keyframes_[static_cast<std::size_t>(index)]; }

  // The newcomer's pose is its tracked one.
  void add(std::unique_ptr<Keyframe> keyframe);
  // Gauss–Newton over the poses only (Sec. IV-D). most_iterations: fewer than configured.
  WindowSummary optimize(std::optional<int> most_iterations = std::nullopt);
  // Shows the two newest keyframes to the calibration; true if that changed its camera.
  bool teach(SelfCalibration& calibration);
  // From now on all keyframes are compared through this camera.
  void set_camera(const CameraModel& camera);
  // The oldest keyframe leaves; its terms stay as a prior. Precondition: size() > 0.
  MarginalizedKeyframe marginalize_oldest();

 private:
  using PairKey = std::pair<std::uint64_t, std::uint64_t>;  // sequences of host and target
  struct Pair {
    int host;
    int target;
    PairTerm term;
  };
  // How a pair compared when last looked at: where the next look starts.
  struct Photometry {
    Brightness brightness;
    double sigma_grey;
  };

  PairTerm linearize_pair(int host, int target);
  std::vector<Pair> covisible_pairs();
  Quadratic energy_about_current(const std::vector<Pair>& pairs) const;
  Eigen::VectorXd increments_since_first() const;
  Matrix6d d_relative_d_host(const Pair& pair) const;
  bool descend(std::vector<Pair>& pairs, const Eigen::VectorXd& step);
  void move(const Eigen::VectorXd& step);
  void forget_pairs_of_oldest();
  double total_energy(const std::vector<Pair>& pairs) const;
  double prior_energy() const;
  Alignment alignment_of(int host, int target) const;

  CameraModel camera_;
  WindowConfig config_;
  PhotometryConfig photometry_;
  std::vector<std::unique_ptr<Keyframe>> keyframes_;
  Quadratic prior_;  // over all of keyframes_
  std::map<PairKey, Photometry> known_;
  // The covisible pairs at the current poses, so that what leaves is marginalised from the very
  // terms that were minimised. None after add().
  std::optional<std::vector<Pair>> pairs_;
  AlignmentWorkspace workspace_;
};

}  // namespace sparsight
