#include "tools/cloud/ply_writer.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

static_assert(std::endian::native == std::endian::little, "vertices are written as they stand");

// One vertex as the header declares it.
constexpr std::size_t kVertexBytes = 3 * 4 + 3 + 4;

std::array<char, kVertexBytes> vertex_of(const MapPoint& point) {
  std::array<char, kVertexBytes> vertex;
  std::memcpy(vertex.data(), point.p_world.data(), 12);
  std::memcpy(vertex.data() + 12, point.rgb.data(), 3);
  std::memcpy(vertex.data() + 15, &point.intensity, 4);
  return vertex;
}

std::string header_of(std::size_t count) {
  return fmt::format(
      "ply\n"
      "format binary_little_endian 1.0\n"
      "comment Sparsight " SPARSIGHT_VERSION
      "\n"
      "comment metres in the world frame, which is the first camera: x right, y down, z forward\n"
      "element vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property float intensity\n"
      "end_header\n",
      count);
}

}  // namespace

Result<void> write_ply(const std::filesystem::path& path, const std::vector<MapPoint>& points) {
  AtomicFile file(path);
  file.stream() << header_of(points.size());
  for (const MapPoint& point : points) {
    const auto vertex = vertex_of(point);
    file.stream().write(vertex.data(), vertex.size());
  }
  return file.commit();
}

}  // namespace sparsight
