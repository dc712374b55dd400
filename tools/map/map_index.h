#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/recording/bytes.h"
#include "hal/result.h"
#include "slam/loop/known_places.h"
#include "tools/map/paged_keyframes.h"

namespace sparsight {

// A map on the disk but for the keyframes' images and clouds: those are in files of their own,
// which are never changed (keyframe_file.h).
struct MapIndex {
  struct File {
    std::string name;         // in the map's folder
    std::uint64_t bytes = 0;  // that belong to the map
  };
  std::uint32_t vocabulary = 0;       // fingerprint_of() what the words are of
  std::vector<std::string> sessions;  // where each was from, for people
  std::vector<File> files;
  std::vector<PagedKeyframes::Place> places;  // of each keyframe
  KnownPlaces known;
};

// Little-endian: "SPARSMAP", u32 version, u64 bytes that follow the checksum, u32 CRC of those
// (crc32.h), then the fields above in their order; see map_index.cc.
std::vector<std::uint8_t> map_index_bytes(const MapIndex& index);

// No byte is trusted: what refers to something refers to what is there, poses are poses,
// information is positive; words ascend. `source` names the file in errors.
Result<MapIndex> parse_map_index(Bytes bytes, const std::string& source);

std::uint32_t fingerprint_of(const Vocabulary& vocabulary);

}  // namespace sparsight
