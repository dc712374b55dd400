#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "drivers/recording/byte_writer.h"
#include "drivers/recording/crc32.h"
#include "tools/map/map_index.h"

namespace {

// Any bytes are a map or an error; a map is written and read back.
void read(const std::vector<std::uint8_t>& bytes) {
  const auto index = sparsight::parse_map_index(bytes, "fuzz");
  if (index && !sparsight::parse_map_index(sparsight::map_index_bytes(*index), "again")) {
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
  writer.bytes(sparsight::as_bytes("SPARSMAP"));
  writer.number<std::uint32_t>(1);
  writer.number<std::uint64_t>(size);
  writer.number(sparsight::crc32_of(bytes));
  writer.bytes(bytes);
  read(sealed);
  return 0;
}
