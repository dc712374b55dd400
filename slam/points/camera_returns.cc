#include "slam/points/camera_returns.h"

#include <algorithm>
#include <cstddef>

namespace sparsight {
namespace {

// Camera motion around the exposure, tabulated: a sweep has 100,000 firings and the exponential map
// is dear. A slot of a 10 Hz sweep lasts 0.2 ms, 6 mm at 30 m/s.
class MotionTable {
 public:
  MotionTable(const Sweep& sweep, const Eigen::Isometry3d& T_camera_lidar,
              const MotionAround& motion) {
    if (!sweep.motion_compensated) {
      for (const LidarReturn& r : sweep.returns) {
        first_ns_ = std::min(first_ns_, r.from_exposure_ns);
        last_ns_ = std::max(last_ns_, r.from_exposure_ns);
      }
    }
    const int slots = last_ns_ > first_ns_ ? kSlots : 1;
    slot_ns_ = (static_cast<double>(last_ns_) - first_ns_) / slots;
    for (int i = 0; i < slots; ++i) {
      const double seconds = 1e-9 * (first_ns_ + (i + 0.5) * slot_ns_);
      const Eigen::Isometry3d T_exposure_firing = motion(seconds);
      table_.push_back((T_exposure_firing * T_camera_lidar).matrix().topRows<3>().cast<float>());
    }
  }

  Eigen::Vector3f in_camera(const LidarReturn& r) const {
    std::size_t slot = 0;
    if (table_.size() > 1) {
      slot = static_cast<std::size_t>((static_cast<double>(r.from_exposure_ns) - first_ns_) /
                                      slot_ns_);
      slot = std::min(slot, table_.size() - 1);
    }
    return table_[slot].leftCols<3>() * r.p_lidar + table_[slot].col(3);
  }

 private:
  static constexpr int kSlots = 512;
  std::int32_t first_ns_ = 0;
  std::int32_t last_ns_ = 0;
  double slot_ns_ = 0.0;
  std::vector<Eigen::Matrix<float, 3, 4>> table_;
};

}  // namespace

MotionAround constant_motion(const Vector6d& twist) {
  return [twist](double seconds) { return exp_se3(twist * seconds); };
}

std::vector<CameraReturn> returns_in_image(const Sweep& sweep, const CameraModel& camera,
                                           const Eigen::Isometry3d& T_camera_lidar,
                                           const MotionAround& motion) {
  const MotionTable table(sweep, T_camera_lidar, motion);
  std::vector<CameraReturn> result;
  result.reserve(sweep.returns.size() / 2);
  for (const LidarReturn& r : sweep.returns) {
    const Eigen::Vector3f p = table.in_camera(r);
    Eigen::Vector2d pixel;
    if (!camera.project(p.cast<double>(), pixel) || !camera.contains(pixel, 0.0)) continue;
    result.push_back(
        {.p_camera = p, .pixel = pixel.cast<float>(), .intensity = r.intensity, .ring = r.ring});
  }
  return result;
}

}  // namespace sparsight
