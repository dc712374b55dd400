#include "tests/benchmarks/made_drive.h"

#include <array>
#include <utility>

#include "slam/points/point_selection.h"
#include "slam/points/visibility.h"
#include "tests/synthetic/synthetic_source.h"

namespace sparsight {
namespace {

constexpr std::size_t kFrames = 8;  // a window of seven, and one more to track

MadeDrive render_drive(const char* name, int width, int height) {
  MadeDrive drive;
  drive.scene = synthetic::make_scene(name).value();
  drive.scene.resize(width, height);
  drive.scene.imager.threads = 2;
  drive.photometry.affine_brightness = true;
  drive.photometry.gradient_weight_constant = 50.0;
  synthetic::SyntheticSource source(drive.scene, kFrames);
  while (auto frame = source.next()) {
    drive.T_world_camera.push_back(source.T_first_camera(drive.frames.size()));
    drive.frames.push_back(std::move(*frame));
  }
  return drive;
}

std::vector<SelectedPoint> every_nth(const std::vector<SelectedPoint>& points, std::size_t wanted) {
  if (points.size() <= wanted) return points;
  std::vector<SelectedPoint> kept;
  for (std::size_t i = 0; i < wanted; ++i) kept.push_back(points[i * points.size() / wanted]);
  return kept;
}

}  // namespace

std::vector<CameraReturn> MadeDrive::returns(std::size_t frame) const {
  return returns_in_image(frames[frame].sweep, CameraModel(scene.rig.camera),
                          scene.rig.T_camera_lidar, constant_motion(Vector6d::Zero()));
}

std::unique_ptr<Keyframe> MadeDrive::keyframe(std::size_t frame) const {
  const CameraModel camera(scene.rig.camera);
  auto keyframe = std::make_unique<Keyframe>();
  keyframe->sequence = frame;
  keyframe->exposure = frames[frame].exposure;
  keyframe->T_world_camera = T_world_camera[frame];
  keyframe->pyramid = ImagePyramid(frames[frame].grey, kLevels);
  PointSelectionConfig selection;
  selection.bin_deg = 1.0;
  const std::vector<CameraReturn> seen = returns(frame);
  keyframe->points = every_nth(
      select_points(seen, hidden_from_camera(seen, camera), frames[frame].grey, camera, selection),
      kPoints);
  for (const SelectedPoint& point : keyframe->points) {
    keyframe->mean_inverse_depth +=
        1.0 / (point.p_camera.z() * static_cast<double>(keyframe->points.size()));
  }
  for (int level = 0; level < keyframe->pyramid.levels(); ++level) {
    keyframe->patches.push_back(make_patches(keyframe->pyramid, level, camera, keyframe->points,
                                             photometry.gradient_weight_constant));
  }
  return keyframe;
}

const MadeDrive& made_drive(int name) {
  if (name == kHall) {
    static const MadeDrive hall = render_drive("hall", 800, 600);
    return hall;
  }
  static const MadeDrive street = render_drive("street", 1241, 376);
  return street;
}

void each_drive(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("hall")->Arg(kStreet)->Arg(kHall)->Unit(benchmark::kMicrosecond);
}

}  // namespace sparsight
