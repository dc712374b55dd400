#pragma once

namespace sparsight {

// Which LiDAR returns are tracked (Sec. IV-B4 of the paper).
struct PointSelectionConfig {
  double bin_deg = 2.0;      // one point per bin_deg x bin_deg bin of the sphere
  double min_depth_m = 0.3;  // along the optical axis
  double max_depth_m = 120.0;
  bool reject_depth_edges = true;
  bool reject_hidden = true;
};

}  // namespace sparsight
