#include "tools/map/keyframe_record.h"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/recording/byte_reader.h"
#include "drivers/recording/byte_writer.h"
#include "drivers/recording/crc32.h"

namespace sparsight {
namespace {

constexpr std::uint32_t kRecordMagic = 0x31464b53;  // "SKF1"
constexpr std::size_t kRecordHeadBytes = 12;
constexpr std::size_t kPointBytes = 20;
constexpr std::uint32_t kLargestSide = 1 << 15;  // pixels
constexpr std::uint8_t kColored = 1;

void write_point(const CloudPoint& point, ByteWriter& writer) {
  for (const float coordinate : point.p_camera) writer.number(coordinate);
  writer.number(point.intensity);
  writer.bytes(point.rgb);
  writer.number<std::uint8_t>(point.colored ? kColored : 0);
}

CloudPoint read_point(ByteReader& reader) {
  CloudPoint point;
  for (float& coordinate : point.p_camera) coordinate = reader.number<float>();
  point.intensity = reader.number<float>();
  std::ranges::copy(reader.take(3), point.rgb.begin());
  point.colored = (reader.number<std::uint8_t>() & kColored) != 0;
  return point;
}

bool read_image(ByteReader& reader, GreyImage& image) {
  const auto width = reader.number<std::uint32_t>();
  const auto height = reader.number<std::uint32_t>();
  if (width > kLargestSide || height > kLargestSide) return false;
  const Bytes pixels = reader.take(std::uint64_t{width} * height);
  image = {static_cast<int>(width), static_cast<int>(height), {pixels.begin(), pixels.end()}};
  return reader.ok();
}

bool read_cloud(ByteReader& reader, std::vector<CloudPoint>& cloud) {
  const auto count = reader.number<std::uint32_t>();
  if (reader.left() != std::uint64_t{count} * kPointBytes) return false;
  cloud.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    cloud.push_back(read_point(reader));
    if (!cloud.back().p_camera.allFinite()) return false;
  }
  return reader.ok();
}

tl::unexpected<Error> damaged(const std::string& source, const char* what) {
  return fail(ErrorCode::kMalformed, fmt::format("{}: {}: this keyframe is damaged; it is left out "
                                                 "of loops and of the map",
                                                 source, what));
}

}  // namespace

std::vector<std::uint8_t> keyframe_record(const KeyframeBulk& bulk) {
  std::vector<std::uint8_t> record;
  record.reserve(kRecordHeadBytes + 12 + bulk.image.pixels.size() +
                 kPointBytes * bulk.cloud_camera.size());
  ByteWriter writer(record);
  writer.number(kRecordMagic);
  writer.number<std::uint64_t>(0);  // length and checksum, when they are known
  writer.number(static_cast<std::uint32_t>(bulk.image.width));
  writer.number(static_cast<std::uint32_t>(bulk.image.height));
  writer.bytes(bulk.image.pixels);
  writer.number(static_cast<std::uint32_t>(bulk.cloud_camera.size()));
  for (const CloudPoint& point : bulk.cloud_camera) write_point(point, writer);
  const Bytes payload = Bytes(record).subspan(kRecordHeadBytes);
  writer.patch(4, static_cast<std::uint32_t>(payload.size()));
  writer.patch(8, crc32_of(payload));
  return record;
}

Result<KeyframeBulk> parse_keyframe_record(Bytes record, const std::string& source) {
  ByteReader reader(record);
  const auto magic = reader.number<std::uint32_t>();
  const auto length = reader.number<std::uint32_t>();
  const auto checksum = reader.number<std::uint32_t>();
  if (!reader.ok() || magic != kRecordMagic) return damaged(source, "no keyframe stands here");
  if (length != reader.left()) return damaged(source, "its length is not what it says");
  if (crc32_of(record.subspan(kRecordHeadBytes)) != checksum) return damaged(source, "checksum");
  KeyframeBulk bulk;
  if (!read_image(reader, bulk.image)) return damaged(source, "its image is cut off");
  if (!read_cloud(reader, bulk.cloud_camera)) return damaged(source, "its cloud is cut off");
  return bulk;
}

}  // namespace sparsight
