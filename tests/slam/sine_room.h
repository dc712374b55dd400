#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "slam/geometry/se3.h"
#include "slam/keyframe.h"
#include "slam/tracking/photometric_kernel.h"
#include "tests/slam/analytic_image.h"

namespace sparsight {

// A room whose walls are cut from a block of sines: grey is a smooth function of the place alone,
// so that images, depths and poses are exact up to the rounding to 8 bits. World axes as the
// camera's: x right, y down, z forward; the camera starts at the origin.
class SineRoom {
 public:
  CameraIntrinsics intrinsics{160, 120, 120.0, 120.0, 79.3, 59.8};
  Eigen::Vector3d lowest{-4.0, -2.5, -5.0};
  Eigen::Vector3d highest{4.0, 1.6, 7.0};
  double contrast = 14.0;  // amplitude of each of the eight sines
  std::uint32_t pattern = 1;

  CameraModel camera() const { return CameraModel(intrinsics); }

  double grey(const Eigen::Vector3d& p_world) const {
    double sum = 128.0;
    for (const Wave& wave : waves()) {
      sum += contrast * std::sin(wave.k.dot(p_world) + wave.phase);
    }
    return sum;
  }

  // Where the ray leaves the room: its walls are convex and seen from inside.
  Eigen::Vector3d wall_along(const Eigen::Vector3d& origin,
                             const Eigen::Vector3d& direction) const {
    double distance = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (direction(axis) == 0.0) continue;
      const double wall = direction(axis) > 0.0 ? highest(axis) : lowest(axis);
      distance = std::min(distance, (wall - origin(axis)) / direction(axis));
    }
    return origin + distance * direction;
  }

  Eigen::Vector3d p_world_at(const CameraModel& lens, const Eigen::Isometry3d& T_world_camera,
                             double u, double v) const {
    return wall_along(T_world_camera.translation(),
                      T_world_camera.linear() * lens.unproject({u, v}));
  }
  Eigen::Vector3d p_world_at(const Eigen::Isometry3d& T_world_camera, double u, double v) const {
    return p_world_at(camera(), T_world_camera, u, v);
  }

  // noise_grey: standard deviation; its draws depend on the seed alone.
  GreyImage image(const Eigen::Isometry3d& T_world_camera, const Brightness& brightness = {},
                  double noise_grey = 0.0, std::uint32_t seed = 1) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    const CameraModel lens = camera();
    return analytic_image(intrinsics.width, intrinsics.height, [&](double u, double v) {
      return brightness.gain * grey(p_world_at(lens, T_world_camera, u, v)) + brightness.offset +
             noise_grey * noise(random);
    });
  }

  std::vector<SelectedPoint> points(const Eigen::Isometry3d& T_world_camera,
                                    int spacing_px = 8) const {
    const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
    const CameraModel lens = camera();
    const auto p_camera_at = [&](double u, double v) -> Eigen::Vector3d {
      return T_camera_world * p_world_at(lens, T_world_camera, u, v);
    };
    std::vector<SelectedPoint> result;
    for (int v = 5; v < intrinsics.height - 5; v += spacing_px) {
      for (int u = 5; u < intrinsics.width - 5; u += spacing_px) {
        SelectedPoint point{.p_camera = p_camera_at(u, v).cast<float>(),
                            .pixel = Eigen::Vector2i(u, v).cast<float>()};
        const Eigen::Vector2d slope(
            1.0 / p_camera_at(u + 1, v).z() - 1.0 / p_camera_at(u - 1, v).z(),
            1.0 / p_camera_at(u, v + 1).z() - 1.0 / p_camera_at(u, v - 1).z());
        point.inverse_depth_slope = (0.5 * slope).cast<float>();
        result.push_back(point);
      }
    }
    return result;
  }

  Keyframe keyframe(std::uint64_t sequence, const Eigen::Isometry3d& T_world_camera,
                    const GreyImage& image, int levels = 3) const {
    Keyframe result;
    result.sequence = sequence;
    result.T_world_camera = T_world_camera;
    result.pyramid = ImagePyramid(image, levels);
    result.points = points(T_world_camera);
    for (int level = 0; level < levels; ++level) {
      result.patches.push_back(make_patches(result.pyramid, level, camera(), result.points, 0.0));
    }
    double sum = 0.0;
    for (const SelectedPoint& point : result.points) sum += 1.0 / point.p_camera.z();
    result.mean_inverse_depth = sum / static_cast<double>(result.points.size());
    return result;
  }
  Keyframe keyframe(std::uint64_t sequence, const Eigen::Isometry3d& T_world_camera) const {
    return keyframe(sequence, T_world_camera, image(T_world_camera));
  }

 private:
  struct Wave {
    Eigen::Vector3d k;  // radians per metre
    double phase;
  };

  // Wavelengths of 1 to 3 m, directions all around.
  std::array<Wave, 8> waves() const {
    std::array<Wave, 8> result;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double turn = 2.4 * static_cast<double>(i) + 0.7 * pattern;
      const double height = -0.9 + 0.25 * static_cast<double>(i);
      const double side = std::sqrt(1.0 - height * height);
      const double wavelength_m = 1.0 + 0.28 * static_cast<double>((i * 3 + pattern) % 8);
      result[i] = {2.0 * M_PI / wavelength_m *
                       Eigen::Vector3d(side * std::cos(turn), height, side * std::sin(turn)),
                   1.3 * static_cast<double>(i * i) + 2.1 * pattern};
    }
    return result;
  }
};

inline Eigen::Isometry3d pose(double rx, double ry, double rz, double x, double y, double z) {
  Vector6d xi;
  xi << rx, ry, rz, x, y, z;
  return exp_se3(xi);
}

inline double turn_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

inline double shift_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

}  // namespace sparsight
