#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "drivers/vlp16/sweep_assembler.h"
#include "drivers/vlp16/vlp16_decoder.h"

namespace {

void expect(bool holds) {
  if (!holds) __builtin_trap();
}

void expect_sound(const sparsight::DecodedPacket& packet) {
  expect(packet.returns.size() <= 2 * 192 * 2);
  expect(packet.first_azimuth_deg >= 0.0 && packet.first_azimuth_deg < 360.0);
  expect(std::isfinite(packet.turned_deg));
  for (const sparsight::TimedReturn& point : packet.returns) {
    expect(point.p_lidar.allFinite() && point.p_lidar.norm() < 132.0F);
    expect(point.azimuth_deg >= 0.0F && point.azimuth_deg < 360.0F);
    expect(point.fired >= packet.first_firing && point.fired <= packet.last_firing);
    expect(point.ring < 16);
  }
}

}  // namespace

// Packets of any content, one after the other, are refused or read, and no return that is read gets
// lost on the way into revolutions.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sparsight::LidarConfig config;
  config.max_range_m = 200.0;
  sparsight::Vlp16Decoder decoder(config);
  sparsight::SweepAssembler assembler;
  sparsight::LidarPacket packet;
  sparsight::DecodedPacket decoded;
  std::size_t fed = 0;
  packet.arrival = sparsight::HostTime(std::chrono::seconds(1));
  for (; size >= packet.payload.size(); size -= packet.payload.size()) {
    std::copy_n(data, packet.payload.size(), packet.payload.begin());
    data += packet.payload.size();
    packet.arrival += std::chrono::microseconds(1327);
    if (!decoder.decode(packet, decoded)) continue;
    expect_sound(decoded);
    fed += decoded.returns.size();
    assembler.add(decoded);
  }
  assembler.flush();
  while (const auto revolution = assembler.take()) {
    expect(revolution->returns.size() <= fed);
    fed -= revolution->returns.size();
  }
  expect(fed == 0);
  return 0;
}
