#pragma once

#include <vector>

#include "hal/sweep.h"

namespace sparsight {

// Where the returns of a scan lie, seen from the scanner. Degrees.
struct ScanAngles {
  std::vector<float> azimuth;    // counter-clockwise from straight ahead, [0, 360)
  std::vector<float> elevation;  // up is positive
};
ScanAngles scan_angles(const std::vector<LidarReturn>& returns);

// The widest sector of azimuth without any return, within half a degree. Of a full turn it is
// narrow, of a cropped scan or a depth image it is wide.
struct AzimuthGap {
  float center = 0.0F;
  float width = 0.0F;
};
AzimuthGap widest_gap(const std::vector<float>& azimuth);

// The angle in [0, 360), of one at most a few turns away.
float wrapped_360(float degrees);

}  // namespace sparsight
