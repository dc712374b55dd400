#include "drivers/datasets/velodyne_scan.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "drivers/datasets/text_lines.h"

namespace sparsight {
namespace {

constexpr std::size_t kPointBytes = 4 * sizeof(float);
static_assert(std::endian::native == std::endian::little, "the file's byte order");

// No LiDAR sees so far, and the square still fits a float.
constexpr float kMaxCoordinate = 1e5F;

bool plausible(const LidarReturn& point) {
  return point.p_lidar.allFinite() && point.p_lidar.cwiseAbs().maxCoeff() < kMaxCoordinate;
}

void add_point(const std::array<float, 4>& values, StoredScan& scan) {
  LidarReturn point;
  point.p_lidar = {values[0], values[1], values[2]};
  point.intensity = std::isfinite(values[3]) ? values[3] : 0.0F;
  if (!plausible(point)) {
    ++scan.refused;
  } else if (!point.p_lidar.isZero(0.0F)) {
    scan.returns.push_back(point);
  }
}

}  // namespace

Result<StoredScan> parse_velodyne_scan(std::string_view bytes, const std::string& file) {
  if (bytes.size() % kPointBytes != 0) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: {} bytes are not a whole number of 16-byte points; the file is "
                            "truncated or not a scan",
                            file, bytes.size()));
  }
  StoredScan scan;
  scan.returns.reserve(bytes.size() / kPointBytes);
  for (std::size_t begin = 0; begin < bytes.size(); begin += kPointBytes) {
    std::array<float, 4> values;
    std::memcpy(values.data(), bytes.data() + begin, kPointBytes);
    add_point(values, scan);
  }
  return scan;
}

Result<StoredScan> parse_velodyne_text(std::string_view text, const std::string& file) {
  StoredScan scan;
  std::size_t number = 0;
  for (const std::string_view line : split_lines(text)) {
    ++number;
    const std::vector<std::string_view> words = split_words(line);
    if (words.empty()) continue;
    std::array<float, 4> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto value =
          words.size() == values.size() ? number_from<float>(words[i]) : std::nullopt;
      if (!value) {
        return fail(ErrorCode::kMalformed,
                    fmt::format("{}:{}: \"{}\" is not a point \"x y z intensity\"", file, number,
                                line.substr(0, 60)));
      }
      values[i] = *value;
    }
    add_point(values, scan);
  }
  return scan;
}

}  // namespace sparsight
