#include "tools/cloud/las_writer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "drivers/recording/byte_writer.h"
#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

using Bounds = Eigen::AlignedBox3d;

// LAS 1.4 R15, Tables 3, 5 and 15, 16.
constexpr std::uint16_t kHeaderBytes = 375;
constexpr std::uint16_t kRecordHeaderBytes = 54;
constexpr std::uint16_t kPointBytes = 36;
constexpr std::uint8_t kPointFormat = 7;
constexpr std::uint16_t kCoordinatesAreWkt = 1 << 4;  // which formats 6 to 10 require
constexpr std::uint16_t kWktRecord = 2112;
constexpr double kScale = 0.001;  // metres

constexpr std::string_view kCoordinateSystem =
    "LOCAL_CS[\"Sparsight map: x right, y forward, z up as the first camera stood\","
    "LOCAL_DATUM[\"First camera\",0],UNIT[\"metre\",1],"
    "AXIS[\"Right\",OTHER],AXIS[\"Forward\",OTHER],AXIS[\"Up\",UP]]";

void padded(ByteWriter& writer, std::string_view text, std::size_t size) {
  writer.bytes(as_bytes(text));
  for (std::size_t i = text.size(); i < size; ++i) writer.number<std::uint8_t>(0);
}

// From metres to the file's whole numbers. A whole offset near the middle keeps them small.
class Quantization {
 public:
  explicit Quantization(const std::vector<MapPoint>& points) {
    Bounds bounds;
    for (const MapPoint& point : points) bounds.extend(las_position(point.p_world));
    if (!bounds.isEmpty()) offset_ = bounds.center().array().round();
    for (const MapPoint& point : points) {
      bounds_.extend(offset_ + kScale * numbers_of(point).cast<double>());
    }
    if (bounds_.isEmpty()) bounds_.extend(Eigen::Vector3d::Zero());
  }

  Eigen::Vector3i numbers_of(const MapPoint& point) const {
    return ((las_position(point.p_world) - offset_) / kScale).array().round().cast<std::int32_t>();
  }
  const Eigen::Vector3d& offset() const { return offset_; }
  const Bounds& bounds() const { return bounds_; }  // of the points as they stand in the file

 private:
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  Bounds bounds_;
};

void write_counts(ByteWriter& writer, std::uint64_t points) {
  constexpr int kReturns = 15;
  writer.number(points);
  writer.number(points);  // first returns: all
  for (int i = 1; i < kReturns; ++i) writer.number<std::uint64_t>(0);
}

// Table 3.
void write_header(ByteWriter& writer, const Quantization& quantization, std::uint64_t points) {
  writer.bytes(as_bytes("LASF"));
  writer.number<std::uint16_t>(0);  // file source
  writer.number(kCoordinatesAreWkt);
  padded(writer, "", 16);  // project
  writer.number<std::uint8_t>(1);
  writer.number<std::uint8_t>(4);
  padded(writer, "Sparsight", 32);
  padded(writer, "Sparsight " SPARSIGHT_VERSION, 32);
  writer.number<std::uint32_t>(0);  // day and year
  writer.number(kHeaderBytes);
  writer.number(
      static_cast<std::uint32_t>(kHeaderBytes + kRecordHeaderBytes + kCoordinateSystem.size() + 1));
  writer.number<std::uint32_t>(1);  // variable length records
  writer.number(kPointFormat);
  writer.number(kPointBytes);
  padded(writer, "", 24);  // what older readers count by; format 7 is none they know
  for (int axis = 0; axis < 3; ++axis) writer.number(kScale);
  for (const double offset : quantization.offset()) writer.number(offset);
  for (int axis = 0; axis < 3; ++axis) {
    writer.number(quantization.bounds().max()[axis]);
    writer.number(quantization.bounds().min()[axis]);
  }
  padded(writer, "", 8 + 8 + 4);  // no waveforms, no extended records
  write_counts(writer, points);
}

// Table 5 and what it heads.
void write_coordinate_system(ByteWriter& writer) {
  writer.number<std::uint16_t>(0);
  padded(writer, "LASF_Projection", 16);
  writer.number(kWktRecord);
  writer.number(static_cast<std::uint16_t>(kCoordinateSystem.size() + 1));
  padded(writer, "OGC WKT coordinate system", 32);
  padded(writer, kCoordinateSystem, kCoordinateSystem.size() + 1);
}

std::uint16_t full_range(float intensity, float full_intensity) {
  const float share = std::clamp(intensity / full_intensity, 0.0F, 1.0F);
  return static_cast<std::uint16_t>(std::lround(65535.0F * share));
}

// Tables 15 and 16.
void write_point(ByteWriter& writer, const MapPoint& point, const Quantization& quantization,
                 float full_intensity) {
  constexpr std::uint8_t kFirstOfOne = 0x11;
  for (const std::int32_t number : quantization.numbers_of(point)) writer.number(number);
  writer.number(full_range(point.intensity, full_intensity));
  writer.number(kFirstOfOne);
  padded(writer, "", 1 + 1 + 1 + 2 + 2 + 8);  // flags, class, user, angle, source, time
  for (const std::uint8_t channel : point.rgb) {
    writer.number(static_cast<std::uint16_t>(257 * channel));
  }
}

}  // namespace

Result<void> write_las(const std::filesystem::path& path, const std::vector<MapPoint>& points,
                       float full_intensity) {
  const Quantization quantization(points);
  std::vector<std::uint8_t> bytes;
  ByteWriter writer(bytes);
  write_header(writer, quantization, points.size());
  write_coordinate_system(writer);
  AtomicFile file(path);
  const auto flush = [&] {
    file.stream() << as_text(bytes);
    bytes.clear();
  };
  flush();
  for (const MapPoint& point : points) {
    write_point(writer, point, quantization, full_intensity);
    flush();
  }
  return file.commit();
}

}  // namespace sparsight
