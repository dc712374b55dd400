#pragma once

#include <Eigen/Core>

#include "slam/geometry/camera_model.h"
#include "slam/keyframe.h"
#include "slam/tracking/photometric_alignment.h"

namespace sparsight {

struct SelfCalibrationConfig {
  bool enabled = false;
  // What is believed of the given calibration, one sigma; three are never exceeded.
  double focal_sigma = 0.003;  // of fx and fy, relative
  double k1_sigma = 0.01;      // of the first radial coefficient
  // Share of what the residuals tell that is believed: neighbouring pixels, and keyframes that show
  // the same places, do not err independently.
  double believed_share = 0.02;
};

// Focal length and radial distortion as the images themselves show them. Rectified images keep a
// radial error of a pixel or two towards the border, and what it does to image motion is else read
// as motion of the camera: 0.7 % too far on a straight road. Estimated from the residuals that the
// poses come from, as in DSO (Engel et al. 2018, Sec. 2.3), here with known depth and filtered over
// all keyframes. Thread-bound.
class SelfCalibration {
 public:
  SelfCalibration(const CameraIntrinsics& given, const SelfCalibrationConfig& config);

  // Learns from the host's points as seen in another keyframe: `linearization` at `at`, both
  // through camera(). Pose and brightness between the two are eliminated.
  void observe(const Keyframe& host, const Alignment& at, const Linearization& linearization,
               const PhotometryConfig& photometry);
  // Takes what was learned into camera(), once that would move a pixel at the image's corner.
  // True if it did.
  bool update();

  const CameraModel& camera() const { return camera_; }

 private:
  // [log of the focal scale, addition to k1]
  using Parameters = Eigen::Vector2d;

  CameraModel with(const Parameters& parameters) const;

  CameraIntrinsics given_;
  Parameters sigma_;
  double believed_share_;
  Parameters in_force_ = Parameters::Zero();
  CameraModel camera_;
  Eigen::Matrix2d H_;  // information on the parameters, the belief in the given ones included
  Parameters b_ = Parameters::Zero();  // H_ * parameters
};

}  // namespace sparsight
