#include "tools/map/map_index.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>

#include "drivers/recording/byte_reader.h"
#include "drivers/recording/byte_writer.h"
#include "drivers/recording/crc32.h"

namespace sparsight {
namespace {

constexpr std::string_view kMagic = "SPARSMAP";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kIndexHeadBytes = 8 + 4 + 8 + 4;

// Rows of the 3x4 matrix.
void write_transform(ByteWriter& writer, const Eigen::Isometry3d& T) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) writer.number(T(row, column));
  }
}

std::optional<Eigen::Isometry3d> read_transform(ByteReader& reader) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) T(row, column) = reader.number<double>();
  }
  constexpr double kRounding = 1e-6;
  constexpr double kFarthest_m = 1e7;
  const Eigen::Matrix3d R = T.linear();
  const bool rotation =
      (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRounding && R.determinant() > 0.0;
  if (!reader.ok() || !rotation || !(T.translation().norm() < kFarthest_m)) return std::nullopt;
  return T;
}

void write_camera(ByteWriter& writer, const CameraIntrinsics& c) {
  writer.number(static_cast<std::int32_t>(c.width));
  writer.number(static_cast<std::int32_t>(c.height));
  for (const double value : {c.fx, c.fy, c.cx, c.cy, c.k1, c.k2, c.p1, c.p2, c.k3}) {
    writer.number(value);
  }
}

bool read_camera(ByteReader& reader, CameraIntrinsics& c) {
  c.width = reader.number<std::int32_t>();
  c.height = reader.number<std::int32_t>();
  bool finite = true;
  for (double* value : {&c.fx, &c.fy, &c.cx, &c.cy, &c.k1, &c.k2, &c.p1, &c.p2, &c.k3}) {
    *value = reader.number<double>();
    finite = finite && std::isfinite(*value);
  }
  constexpr int kLargestSide = 1 << 15;
  return finite && c.width > 0 && c.height > 0 && c.width <= kLargestSide &&
         c.height <= kLargestSide && c.fx > 0.0 && c.fy > 0.0;
}

void write_bag(ByteWriter& writer, const BagOfWords& bag) {
  writer.number(static_cast<std::uint32_t>(bag.size()));
  for (const WordWeight& one : bag) {
    writer.number(one.word);
    writer.number(one.weight);
  }
}

bool read_bag(ByteReader& reader, BagOfWords& bag) {
  const auto count = reader.number<std::uint32_t>();
  if (count > reader.left() / 8) return false;
  bag.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    bag[i] = {reader.number<std::uint32_t>(), reader.number<float>()};
    if (i > 0 && bag[i].word <= bag[i - 1].word) return false;
    if (!(bag[i].weight >= 0.0F && bag[i].weight <= 1.001F)) return false;
  }
  return reader.ok();
}

void write_place(ByteWriter& writer, const PagedKeyframes::Place& place) {
  writer.number(static_cast<std::uint32_t>(place.file));
  writer.number(place.record ? place.record->offset : 0);
  writer.number(place.record ? place.record->bytes : 0);  // 0: it could not be kept
}

bool read_place(ByteReader& reader, const std::vector<MapIndex::File>& files,
                PagedKeyframes::Place& place) {
  place.file = reader.number<std::uint32_t>();
  const KeyframePlace record{reader.number<std::uint64_t>(), reader.number<std::uint32_t>()};
  if (record.bytes == 0) return reader.ok();
  if (place.file >= files.size()) return false;
  const std::uint64_t end = files[place.file].bytes;
  if (record.offset > end || record.bytes > end - record.offset) return false;
  place.record = record;
  return reader.ok();
}

void write_keyframe(ByteWriter& writer, const KnownKeyframe& keyframe) {
  writer.number(keyframe.session);
  writer.number(keyframe.sequence);
  writer.number(static_cast<std::uint32_t>(keyframe.submap));
  write_camera(writer, keyframe.camera);
  write_transform(writer, keyframe.T_odometry_camera);
  write_transform(writer, keyframe.T_map_camera);
  write_bag(writer, keyframe.bag);
}

// `before`: those that were read already.
bool read_keyframe(ByteReader& reader, const std::vector<KnownKeyframe>& before,
                   std::size_t sessions, KnownKeyframe& keyframe) {
  keyframe.session = reader.number<std::uint32_t>();
  keyframe.sequence = reader.number<std::uint64_t>();
  keyframe.submap = reader.number<std::uint32_t>();
  if (keyframe.session >= sessions || !read_camera(reader, keyframe.camera)) return false;
  // It begins a sub-map or goes on with the one of the keyframe before.
  const std::size_t number = before.size();
  if (keyframe.submap != number && (before.empty() || keyframe.submap != before.back().submap)) {
    return false;
  }
  const auto T_odometry_camera = read_transform(reader);
  const auto T_map_camera = read_transform(reader);
  if (!T_odometry_camera || !T_map_camera) return false;
  keyframe.T_odometry_camera = *T_odometry_camera;
  keyframe.T_map_camera = *T_map_camera;
  return read_bag(reader, keyframe.bag);
}

void write_edge(ByteWriter& writer, const PoseEdge& edge) {
  writer.number(static_cast<std::uint32_t>(edge.from));
  writer.number(static_cast<std::uint32_t>(edge.to));
  writer.number<std::uint8_t>(edge.loop ? 1 : 0);
  write_transform(writer, edge.T_from_to);
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) writer.number(edge.information(row, column));
  }
}

bool read_edge(ByteReader& reader, std::size_t keyframes, PoseEdge& edge) {
  edge.from = reader.number<std::uint32_t>();
  edge.to = reader.number<std::uint32_t>();
  edge.loop = reader.number<std::uint8_t>() != 0;
  const auto T = read_transform(reader);
  if (!T || edge.from >= keyframes || edge.to >= keyframes || edge.from == edge.to) return false;
  edge.T_from_to = *T;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      edge.information(row, column) = edge.information(column, row) = reader.number<double>();
    }
  }
  return edge.information.allFinite() &&
         edge.information.llt().info() == Eigen::ComputationInfo::Success;
}

// Of a list, no more than the bytes that are left can hold.
std::optional<std::size_t> count_of(ByteReader& reader, std::size_t least_bytes_each) {
  const auto count = reader.number<std::uint32_t>();
  if (!reader.ok() || count > reader.left() / least_bytes_each) return std::nullopt;
  return count;
}

bool read_files(ByteReader& reader, std::vector<MapIndex::File>& files) {
  const auto count = count_of(reader, 4 + 8);
  if (!count) return false;
  for (std::size_t i = 0; i < *count; ++i) {
    MapIndex::File file{.name = std::string(reader.text())};
    file.bytes = reader.number<std::uint64_t>();
    // A name in the folder, and no way out of it.
    if (file.name.empty() || file.name.starts_with('.') ||
        file.name.find_first_of(std::string_view("/\\\0", 3)) != std::string::npos) {
      return false;
    }
    files.push_back(std::move(file));
  }
  return reader.ok();
}

const char* read_index(ByteReader& reader, MapIndex& index) {
  index.vocabulary = reader.number<std::uint32_t>();
  const auto sessions = count_of(reader, 4);
  if (!sessions) return "its list of sessions is cut off";
  for (std::size_t i = 0; i < *sessions; ++i) index.sessions.emplace_back(reader.text());
  if (!read_files(reader, index.files)) return "its list of files is damaged";
  const auto keyframes = count_of(reader, 300);
  if (!keyframes) return "its list of keyframes is cut off";
  index.places.resize(*keyframes);
  for (PagedKeyframes::Place& place : index.places) {
    KnownKeyframe keyframe;
    if (!read_place(reader, index.files, place) ||
        !read_keyframe(reader, index.known.keyframes, index.sessions.size(), keyframe)) {
      return "a keyframe is damaged";
    }
    index.known.keyframes.push_back(std::move(keyframe));
  }
  const auto edges = count_of(reader, 273);
  if (!edges) return "its graph is cut off";
  index.known.edges.resize(*edges);
  for (PoseEdge& edge : index.known.edges) {
    if (!read_edge(reader, *keyframes, edge)) return "an edge of its graph is damaged";
  }
  return reader.ok() && reader.left() == 0 ? nullptr : "its length is not what it says";
}

}  // namespace

std::vector<std::uint8_t> map_index_bytes(const MapIndex& index) {
  std::vector<std::uint8_t> bytes;
  ByteWriter writer(bytes);
  writer.bytes(as_bytes(kMagic));
  writer.number(kVersion);
  writer.number<std::uint64_t>(0);  // length and checksum, when they are known
  writer.number<std::uint32_t>(0);
  writer.number(index.vocabulary);
  writer.number(static_cast<std::uint32_t>(index.sessions.size()));
  for (const std::string& session : index.sessions) writer.text(session);
  writer.number(static_cast<std::uint32_t>(index.files.size()));
  for (const MapIndex::File& file : index.files) {
    writer.text(file.name);
    writer.number(file.bytes);
  }
  writer.number(static_cast<std::uint32_t>(index.places.size()));
  for (std::size_t i = 0; i < index.places.size(); ++i) {
    write_place(writer, index.places[i]);
    write_keyframe(writer, index.known.keyframes[i]);
  }
  writer.number(static_cast<std::uint32_t>(index.known.edges.size()));
  for (const PoseEdge& edge : index.known.edges) write_edge(writer, edge);
  const Bytes payload = Bytes(bytes).subspan(kIndexHeadBytes);
  writer.patch(12, static_cast<std::uint64_t>(payload.size()));
  writer.patch(20, crc32_of(payload));
  return bytes;
}

Result<MapIndex> parse_map_index(Bytes bytes, const std::string& source) {
  const auto refuse = [&](std::string_view what) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: {}", source, what));
  };
  ByteReader reader(bytes);
  if (as_text(reader.take(kMagic.size())) != kMagic) return refuse("is not a map of Sparsight");
  if (const auto version = reader.number<std::uint32_t>(); version != kVersion) {
    return refuse(
        fmt::format("is of version {}; this program reads version {}", version, kVersion));
  }
  const auto length = reader.number<std::uint64_t>();
  const auto checksum = reader.number<std::uint32_t>();
  if (!reader.ok() || length != reader.left()) return refuse("is cut off");
  if (crc32_of(bytes.subspan(kIndexHeadBytes)) != checksum) return refuse("is damaged (checksum)");
  MapIndex index;
  if (const char* what = read_index(reader, index)) return refuse(what);
  return index;
}

std::uint32_t fingerprint_of(const Vocabulary& vocabulary) {
  return crc32_of(as_bytes(vocabulary.to_bytes()));
}

}  // namespace sparsight
