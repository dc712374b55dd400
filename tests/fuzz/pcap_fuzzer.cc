#include <cstddef>
#include <cstdint>

#include "drivers/vlp16/pcap_reader.h"

// Any bytes are a capture or refused, and any frame carries a datagram that lies within it or none.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  if (const auto datagram = sparsight::udp_of_ethernet(bytes)) {
    const auto payload = datagram->payload;
    if (payload.data() < data || payload.data() + payload.size() > data + size) __builtin_trap();
  }
  auto reader = sparsight::PcapReader::read(bytes, "made.pcap");
  if (!reader) return 0;
  std::size_t total = 0;
  while (const auto captured = reader->next()) {
    for (const std::uint8_t byte : captured->datagram.payload) total += byte;
    if (captured->captured.count() < 0) __builtin_trap();
  }
  return total == SIZE_MAX ? 1 : 0;
}
