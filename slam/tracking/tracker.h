#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "slam/geometry/se3.h"
#include "slam/image/pyramid.h"
#include "slam/tracking/photometric_alignment.h"
#include "slam/tracking/search_budget.h"
#include "slam/tracking/start_ranking.h"
#include "slam/tracking/tracking_target.h"

namespace sparsight {

struct TrackerConfig {
  int pyramid_levels = 4;
  AlignmentConfig alignment;
  // Starts at the level where the expected error of the start is about a pixel; otherwise always at
  // the coarsest. At speed, coarse levels lead away from a good start.
  bool automatic_top_level = false;
  bool scan_speed = false;  // looks for a lower cost at other speeds than that of the minimum
  bool try_other_starts = true;
  bool sweep_arbiter = false;    // where the image leaves a doubt, the LiDAR is asked
  int min_points = 30;           // visible patches, fewer cannot be tracked
  double min_found_share = 0.3;  // of the patches, below: diverged
  // No rig that people or vehicles carry changes its speed faster; a pose that says so is wrong.
  double max_acceleration_m_s2 = 1e3;
};

// Right poses find more than this share of the patches unless strangers fill half of the image.
inline constexpr double kWellFound = 0.55;

struct TrackingResult {
  enum class Status : std::uint8_t { kConverged, kIterationLimit, kTooFewPoints, kDiverged };
  Status status = Status::kTooFewPoints;
  Eigen::Isometry3d T_keyframe_camera = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Zero();  // left perturbation of T_camera_keyframe, eq. (2)
  Brightness brightness;
  int points_used = 0;
  double visible_ratio = 0.0;  // share of the keyframe's points that project into the image
  double residual_sigma_grey = 0.0;
  double found_share = 0.0;  // of the patches, found in the image
  int top_level = 0;
  int attempts = 0;      // starting motions tried
  bool vouched = false;  // for by the LiDAR: right, however little is found

  bool ok() const { return status == Status::kConverged || status == Status::kIterationLimit; }
  bool well_found() const { return ok() && (vouched || found_share >= kWellFound); }
};

// Where the frame is expected.
struct TrackingStart {
  Eigen::Isometry3d T_keyframe_previous = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_keyframe_predicted = Eigen::Isometry3d::Identity();
  Brightness brightness;
  double error_px = std::numeric_limits<double>::infinity();  // of the prediction, in the image
  double found_share = 0.0;                                   // of the last frame
  // Time since the last tracked frame; nothing if its velocity is not known, or has not been
  // confirmed by a frame that was where it had led to expect it.
  std::optional<double> seconds_since_previous;
  // Where refinement ends: 0, or in want of time a coarser level. The pose is then known to that
  // level's pixels, and what is found is judged there.
  int finest_level = 0;
  // Of a search, if there is need of one; none: every start is tried.
  SearchBudget* search_budget = nullptr;
};

// Direct tracking of a frame against a keyframe, Sec. IV-C. Thread-bound; after construction
// real-time-safe.
class Tracker {
 public:
  Tracker(const CameraModel& camera, const TrackerConfig& config,
          const PhotometryConfig& photometry);

  void set_camera(const CameraModel& camera);

  // From the start, and if what that finds leaves a doubt, from everywhere around.
  TrackingResult track(const TrackingTarget& keyframe, const ImagePyramid& image,
                       const TrackingStart& start);
  // The same in steps. From the start alone:
  TrackingResult direct(const TrackingTarget& keyframe, const ImagePyramid& image,
                        const TrackingStart& start);
  // Whether that leaves no doubt.
  bool settled(const TrackingResult& direct, const TrackingStart& start) const;
  // From everywhere around; the better of that and what was found directly.
  TrackingResult search(const TrackingTarget& keyframe, const ImagePyramid& image,
                        const TrackingStart& start, const TrackingResult& direct);
  // Whether a rig can be there by now.
  bool reachable(const Eigen::Isometry3d& T_keyframe_camera, const TrackingStart& start) const;
  // What is seen from a pose as it is, with the start's brightness.
  TrackingResult look(const TrackingTarget& keyframe, const ImagePyramid& image,
                      const Eigen::Isometry3d& T_keyframe_camera, const TrackingStart& start);
  // Looks once for a keyframe of a single point, to the end. The first search may come late, and
  // what only a search touches, memory and code, is to be there then without a page fault.
  void rehearse_search(const ImagePyramid& image);

 private:
  // A start and the coarsest level it needs. `found`: most of what the keyframe shows is seen from
  // there already, so that what is not seen is no part of the scene.
  struct Entry {
    Alignment at;
    int level = 0;
    bool found = false;
  };
  Entry entry(const TrackingTarget& keyframe, const ImagePyramid& image, const TrackingStart& start,
              int coarsest);
  // Coarse to fine, both levels included; leaves the last linearisation in the workspace.
  Alignment refine(const TrackingTarget& keyframe, const ImagePyramid& image,
                   const Alignment& start, int coarsest, int finest,
                   const PhotometryConfig& photometry);
  // At speed the prediction may have led to the wrong one of many minima along the way.
  Alignment past_other_minima(const TrackingTarget& keyframe, const ImagePyramid& image,
                              const Alignment& found, const TrackingStart& start);
  Alignment descend(const TrackingTarget& keyframe, const ImagePyramid& image,
                    const Alignment& start, int coarsest, int finest);
  TrackingResult verdict(const TrackingTarget& keyframe, const Alignment& at,
                         const TrackingStart& start, int top_level) const;
  const std::vector<RankedStart>& ranked_starts(const TrackingTarget& keyframe,
                                                const ImagePyramid& image,
                                                const TrackingStart& start, int coarsest);
  // From all starting motions; what `direct` has found already is not looked for again.
  TrackingResult from_everywhere(const TrackingTarget& keyframe, const ImagePyramid& image,
                                 const TrackingStart& start, int coarsest,
                                 const TrackingResult& direct);
  int levels(const TrackingTarget& keyframe, const ImagePyramid& image) const;

  TrackerConfig config_;
  PhotometryConfig photometry_;
  std::vector<CameraModel> cameras_;  // per level
  AlignmentWorkspace workspace_;
  struct {
    std::vector<Alignment> starts;
    PatchSet sample;
    std::vector<RankedStart> ranked;
  } search_;
};

}  // namespace sparsight
