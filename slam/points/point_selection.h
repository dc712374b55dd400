#pragma once

#include <vector>

#include "hal/image.h"
#include "slam/geometry/camera_model.h"
#include "slam/points/camera_returns.h"
#include "slam/points/selected_point.h"

namespace sparsight {

// Which LiDAR returns are tracked (Sec. IV-B4).
struct PointSelectionConfig {
  double bin_deg = 2.0;      // one point per bin_deg x bin_deg bin of the sphere
  double min_depth_m = 0.3;  // along the optical axis
  double max_depth_m = 120.0;
  bool reject_depth_edges = true;
  bool reject_hidden = true;
  // Gives each pixel of a patch the depth of the surface there, not that of the centre.
  bool surface_slope = false;
};

// Of the returns in each bin of the sphere around the camera the one with the largest image
// gradient, however small that is. Their patches fit into the image. In the order of the bins.
// hidden: of the returns, from visibility.h.
std::vector<SelectedPoint> select_points(const std::vector<CameraReturn>& returns,
                                         const std::vector<bool>& hidden, const GreyImage& image,
                                         const CameraModel& camera,
                                         const PointSelectionConfig& config);

}  // namespace sparsight
