#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "slam/map/voxel_map.h"

namespace sparsight {

enum class CloudFormat : std::uint8_t { kPly, kPcd, kLas };
inline constexpr std::array kCloudFormats = {CloudFormat::kPly, CloudFormat::kPcd,
                                             CloudFormat::kLas};

// "ply": as the option and the file's ending have it.
std::string_view name_of(CloudFormat format);

// Writes a map's points, atomically. full_intensity: what the LiDAR calls the brightest return.
Result<void> write_cloud(const std::filesystem::path& path, CloudFormat format,
                         const std::vector<MapPoint>& points, float full_intensity);

}  // namespace sparsight
