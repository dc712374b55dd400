#include "slam/map/map_composer.h"

#include <utility>

#include "slam/geometry/camera_model.h"
#include "slam/points/camera_returns.h"
#include "slam/points/visibility.h"

namespace sparsight {
namespace {

constexpr std::size_t kReach = 3;  // keyframes on either side

// The cloud's points within the view, and in `which` their numbers in the cloud, if wanted.
void append_returns(const PosedCloud& of, const Eigen::Isometry3d& T_view_world,
                    const CameraModel& camera, std::vector<CameraReturn>& returns,
                    std::vector<std::size_t>* which = nullptr) {
  const Eigen::Isometry3f T = (T_view_world * of.T_world_camera).cast<float>();
  for (std::size_t i = 0; i < of.cloud_camera.size(); ++i) {
    const Eigen::Vector3f p = T * of.cloud_camera[i].p_camera;
    Eigen::Vector2d pixel;
    if (!camera.project(p.cast<double>(), pixel) || !camera.contains(pixel, 0.0)) continue;
    returns.push_back({.p_camera = p, .pixel = pixel.cast<float>()});
    if (which != nullptr) which->push_back(i);
  }
}

}  // namespace

void MapComposer::add(PosedCloud keyframe) {
  nearby_.push_back(std::move(keyframe));
  if (nearby_.size() - next_ > kReach) put(next_++);
  if (next_ > kReach) {
    nearby_.pop_front();
    --next_;
  }
}

void MapComposer::finish() {
  while (next_ < nearby_.size()) put(next_++);
  nearby_.clear();
  next_ = 0;
}

void MapComposer::put(std::size_t index) {
  PosedCloud& keyframe = nearby_[index];
  const CameraModel camera(keyframe.camera);
  const Eigen::Isometry3d T_view_world = keyframe.T_world_camera.inverse();
  std::vector<CameraReturn> returns;
  std::vector<std::size_t> own;
  append_returns(keyframe, T_view_world, camera, returns, &own);
  for (std::size_t other = 0; other < nearby_.size(); ++other) {
    if (other != index) append_returns(nearby_[other], T_view_world, camera, returns);
  }
  const std::vector<bool> hidden = hidden_from_camera(returns, camera);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!hidden[i]) continue;
    keyframe.cloud_camera[own[i]].colored = false;
    keyframe.cloud_camera[own[i]].rgb = {};
  }
  map_.add(keyframe.T_world_camera, keyframe.cloud_camera);
}

}  // namespace sparsight
