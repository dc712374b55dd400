#pragma once

namespace sparsight {

// How brightness is compared, in tracking and in the window alike.
struct PhotometryConfig {
  double student_t_dof = 5.0;  // nu of eq. (5)
  // Down-weights strong gradients, where an error of depth or of projection costs most:
  // c^2 / (c^2 + |grad I|^2), c in grey levels per pixel (DSO, Engel et al. 2018, Sec. 2.2).
  // 0 switches it off.
  double gradient_weight_constant = 0.0;
  // Estimates gain and offset between the images besides the pose.
  bool affine_brightness = false;
  // A patch that disagrees as a whole (a moving car, a reflection) loses weight as a whole.
  bool patch_weights = false;
  // In the window, points whose surroundings are no plane lose weight: a patch there has no one
  // depth.
  bool weigh_down_rough = false;
  // What the keyframe before does not show loses weight from the start, in a new keyframe.
  bool weigh_down_strangers = false;
};

}  // namespace sparsight
