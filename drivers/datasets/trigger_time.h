#pragma once

#include <optional>
#include <vector>

#include "hal/time.h"

namespace sparsight {

// When the images of a KITTI raw drive were exposed. The scanner triggers the cameras as it faces
// forward (Geiger et al. 2013, Sec. 3.1: velodyne_points/timestamps.txt), while an image's own
// stamp is its arrival, 16.6 ms later in drive 2011_09_26_drive_0005. There, the LiDAR's depth
// edges fall on the image's edges with the former, and miss them by pixels with the latter.
//
// `triggers` may be shorter than `arrivals` and have holes; such an image was exposed the usual
// delay before its arrival. Without a plausible usual delay the arrivals are taken as they are.
std::vector<HostTime> exposure_times(std::vector<HostTime> arrivals,
                                     const std::vector<std::optional<HostTime>>& triggers);

}  // namespace sparsight
