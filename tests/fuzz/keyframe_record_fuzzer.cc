#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "drivers/recording/byte_writer.h"
#include "drivers/recording/crc32.h"
#include "tools/map/keyframe_record.h"

namespace {

// Any bytes are a keyframe or an error; a keyframe is written and read back.
void read(const std::vector<std::uint8_t>& bytes) {
  const auto bulk = sparsight::parse_keyframe_record(bytes, "fuzz");
  if (!bulk) {
    return;
  }
  const auto again = sparsight::parse_keyframe_record(sparsight::keyframe_record(*bulk), "again");
  if (!again || again->cloud_camera.size() != bulk->cloud_camera.size() ||
      again->image.pixels != bulk->image.pixels) {
    std::abort();
  }
}

}  // namespace

// As they are, and behind a header that vouches for them: nothing would be found behind a checksum
// that must be guessed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const sparsight::Bytes bytes(data, size);
  read({data, data + size});
  std::vector<std::uint8_t> sealed;
  sparsight::ByteWriter writer(sealed);
  writer.bytes(sparsight::as_bytes("SKF1"));
  writer.number(static_cast<std::uint32_t>(size));
  writer.number(sparsight::crc32_of(bytes));
  writer.bytes(bytes);
  read(sealed);
  return 0;
}
