#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/datasets/scan_angles.h"

namespace sparsight {

// The ring of each return of a scan stored ring after ring: how often the azimuth has started over.
// Where rings start (straight ahead as in KITTI, at the back, at the edge of a cropped scan or of
// an organised depth image) and in which direction they run is found from the scan itself. Nothing,
// if the scan is not stored that way.
std::optional<std::vector<std::uint16_t>> rings_by_wrap(const ScanAngles& angles);

}  // namespace sparsight
