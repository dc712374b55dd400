#pragma once

#include "hal/calibration.h"

namespace sparsight::synthetic {

RigCalibration kitti_rig();      // 1226 x 370, 82 degrees; the LiDAR 0.3 m behind and above
RigCalibration hand_held_rig();  // 800 x 600, 90 degrees; the VLP-16 10 cm above
RigCalibration rgbd_rig();       // 640 x 480, 63 degrees; depth registered to the camera

}  // namespace sparsight::synthetic
