#include "tools/cloud/cloud_file.h"

#include "tools/cloud/las_writer.h"
#include "tools/cloud/pcd_writer.h"
#include "tools/cloud/ply_writer.h"

namespace sparsight {

std::string_view name_of(CloudFormat format) {
  switch (format) {
    case CloudFormat::kPly:
      return "ply";
    case CloudFormat::kPcd:
      return "pcd";
    case CloudFormat::kLas:
      return "las";
  }
  return "unknown";
}

Result<void> write_cloud(const std::filesystem::path& path, CloudFormat format,
                         const std::vector<MapPoint>& points, float full_intensity) {
  switch (format) {
    case CloudFormat::kPly:
      return write_ply(path, points);
    case CloudFormat::kPcd:
      return write_pcd(path, points);
    case CloudFormat::kLas:
      return write_las(path, points, full_intensity);
  }
  return {};
}

}  // namespace sparsight
