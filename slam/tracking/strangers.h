#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "hal/image.h"
#include "slam/geometry/camera_model.h"
#include "slam/points/selected_point.h"
#include "slam/tracking/patch_set.h"

namespace sparsight {

// A new keyframe's points that an earlier image ought to show and does not: most of them lie on
// what moves by itself, a car beside or a bus before the rig. They keep a small part of their
// weight: no moving majority of an image carries the pose away with it, and should the pose have
// been wrong, so that the scene looked strange, the scene still counts.
//
// in_traffic: it took the LiDAR to tell the pose; then what is not surely found is a stranger, too.
// `patches` of the points, whose weights follow, and `earlier`, at the finest level;
// T_earlier_keyframe as tracked.
void weigh_down_strangers(std::vector<SelectedPoint>& points, PatchSet& patches,
                          const GreyImage& earlier, const CameraModel& camera,
                          const Eigen::Isometry3d& T_earlier_keyframe, bool in_traffic);

}  // namespace sparsight
