#pragma once

#include <memory>
#include <optional>
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
  // A pair whose pixels have moved by less since it was linearised keeps its linearisation: most
  // steps move the newest keyframe only (fluid relinearisation, Kaess et al. 2012).
  double relinearization_px = 0.05;
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
  // From now on all keyframes are compared through this camera, through which the latest was made.
  void set_camera(const CameraModel& camera);
  // The oldest keyframe leaves; its terms stay as a prior. Precondition: size() > 0.
  MarginalizedKeyframe marginalize_oldest();

 private:
  struct Pair {
    int host;
    int target;
    PairTerm term;
  };

  PairTerm linearize(int host, int target, const Alignment& start);
  // Looks at keyframes not looked at yet, and again at pairs that have changed.
  void update_pairs();
  void add_if_covisible(int host, int target);
  Quadratic energy_about_current(const std::vector<Pair>& pairs) const;
  Eigen::VectorXd increments_since_first() const;
  Matrix6d d_relative_d_host(const Pair& pair) const;
  // Where the pair stands now, as a left increment of where it was linearised.
  Vector6d moved_since_linearized(const Pair& pair) const;
  double pixels_moved(const Vector6d& xi, const Keyframe& keyframe) const;
  // So far, in space or in brightness, that the pair has to be linearised anew.
  bool outdated(const Pair& pair, const Vector6d& xi) const;
  bool descend(const Eigen::VectorXd& step);
  void move(const Eigen::VectorXd& step);
  double largest_move_px(const Eigen::VectorXd& step) const;
  double total_energy() const;
  double prior_energy() const;
  void forget_pairs_of_oldest();
  Eigen::Isometry3d T_target_host(int host, int target) const;

  CameraModel camera_;
  WindowConfig config_;
  PhotometryConfig photometry_;
  std::vector<std::unique_ptr<Keyframe>> keyframes_;
  Quadratic prior_;  // over all of keyframes_
  // The covisible pairs of the first looked_at_ keyframes. They stay from one optimisation to the
  // next, and what leaves is marginalised from the very terms that were minimised.
  std::vector<Pair> pairs_;
  int looked_at_ = 0;
  double camera_moved_px_ = 0.0;  // since all pairs were linearised anew
  AlignmentWorkspace workspace_;
};

}  // namespace sparsight
