#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "hal/result.h"
#include "slam/map/voxel_map.h"

namespace sparsight {

// LAS 1.4 (ASPRS, R15), point data record format 7: coordinates in whole millimetres, intensity and
// colours over the full 16 bits, as the specification asks. Points without a colour of their own
// are black. Every point is the only return of its pulse; GPS time and the date are 0, which is
// unknown.
//
// LAS calls z the height. So x stays right, y is the world's z (forward at the start) and z its -y:
// up as the first camera stood, not levelled with gravity. The file says so in its coordinate
// system (OGC WKT, LOCAL_CS).
Result<void> write_las(const std::filesystem::path& path, const std::vector<MapPoint>& points,
                       float full_intensity);

// From the world frame to that of the file.
inline Eigen::Vector3d las_position(const Eigen::Vector3f& p_world) {
  return {double{p_world.x()}, double{p_world.z()}, -double{p_world.y()}};
}

}  // namespace sparsight
