#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/vlp16/gprmc.h"
#include "drivers/vlp16/position_packet.h"
#include "drivers/vlp16/vlp16_decoder.h"

// Any text is a sentence or none; any bytes are a position packet or none. The input begins where
// the packet's contents do.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace std::chrono_literals;
  const auto gprmc = sparsight::parse_gprmc({reinterpret_cast<const char*>(data), size});
  if (gprmc && (gprmc->time_of_day < 0h || gprmc->time_of_day > 24h + 1s)) __builtin_trap();

  constexpr std::size_t kContents = 198;
  sparsight::PositionPacket packet;
  std::copy_n(data, std::min(size, packet.payload.size() - kContents),
              packet.payload.begin() + kContents);
  const auto reading = sparsight::read_position_packet(packet.payload);
  if (reading && sparsight::hour_is_utc(*reading) && !reading->gprmc) __builtin_trap();
  sparsight::Vlp16Decoder decoder;
  const auto report = decoder.decode(packet);
  if (report.has_value() != reading.has_value()) __builtin_trap();
  return 0;
}
