#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/calibration.h"
#include "hal/result.h"

namespace sparsight {

// A KITTI calibration file: "NAME: values" on each line. Fields are read on demand, so that one
// that nobody needs (a date, another camera) cannot refuse the file. `file` is for error messages.
class CalibrationText {
 public:
  static Result<CalibrationText> parse(std::string_view text, std::string file);

  bool has(const std::string& field) const { return fields_.contains(field); }
  const std::string& file() const { return file_; }
  // Exactly `count` finite numbers.
  Result<std::vector<double>> numbers(const std::string& field, std::size_t count) const;
  // 3x3, row after row; must be a rotation within the rounding of a printed one.
  Result<Eigen::Matrix3d> rotation(const std::string& field) const;
  // 3x4, row after row.
  Result<Eigen::Isometry3d> transform(const std::string& field) const;
  // The error for a value that is there, but cannot be.
  tl::unexpected<Error> refuse(const std::string& field, const std::string& why) const;

 private:
  struct Field {
    std::size_t line = 0;
    std::string values;
  };
  std::map<std::string, Field> fields_;
  std::string file_;
};

// A rectified camera of a stereo rig (Geiger et al. 2013, Sec. 5): P = K [I | t], with t the
// position of the reference camera in this one.
struct RectifiedCamera {
  CameraIntrinsics intrinsics;  // without image size
  Eigen::Isometry3d T_camera_reference = Eigen::Isometry3d::Identity();
};
Result<RectifiedCamera> rectified_camera(const CalibrationText& text, const std::string& field);

}  // namespace sparsight
