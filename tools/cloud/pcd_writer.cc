#include "tools/cloud/pcd_writer.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD has the bytes of the machine");

std::string pcd_header(std::size_t count) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\n"
      "# Sparsight " SPARSIGHT_VERSION
      ": metres in the world frame, which is the first camera: x right, y down, z forward\n"
      "VERSION 0.7\n"
      "FIELDS x y z rgb intensity\n"
      "SIZE 4 4 4 4 4\n"
      "TYPE F F F F F\n"
      "COUNT 1 1 1 1 1\n"
      "WIDTH {0}\n"
      "HEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\n"
      "POINTS {0}\n"
      "DATA binary\n",
      count);
}

std::array<char, 20> pcd_point(const MapPoint& point) {
  const std::uint32_t rgb = std::uint32_t{point.rgb[0]} << 16 | std::uint32_t{point.rgb[1]} << 8 |
                            std::uint32_t{point.rgb[2]};
  std::array<char, 20> bytes;
  std::memcpy(bytes.data(), point.p_world.data(), 12);
  std::memcpy(bytes.data() + 12, &rgb, 4);
  std::memcpy(bytes.data() + 16, &point.intensity, 4);
  return bytes;
}

}  // namespace

Result<void> write_pcd(const std::filesystem::path& path, const std::vector<MapPoint>& points) {
  AtomicFile file(path);
  file.stream() << pcd_header(points.size());
  for (const MapPoint& point : points) {
    const auto bytes = pcd_point(point);
    file.stream().write(bytes.data(), bytes.size());
  }
  return file.commit();
}

}  // namespace sparsight
