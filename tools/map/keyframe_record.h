#pragma once

#include <cstdint>
#include <vector>

#include "drivers/recording/bytes.h"
#include "hal/result.h"
#include "slam/map/keyframe_store.h"

namespace sparsight {

// A keyframe's bulk as it stands in a file. Little-endian:
//   magic "SKF1", u32 bytes that follow the checksum, u32 CRC of those (crc32.h);
//   u32 width, u32 height, the image's pixels row after row;
//   u32 points, of each x y z intensity in f32 (camera frame, metres), r g b, flags (bit 0: the
//   camera saw the point, so that the colour is its own).
std::vector<std::uint8_t> keyframe_record(const KeyframeBulk& bulk);

// The whole record and nothing else; `source` names it in errors.
Result<KeyframeBulk> parse_keyframe_record(Bytes record, const std::string& source);

}  // namespace sparsight
