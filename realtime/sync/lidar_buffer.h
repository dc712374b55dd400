#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/lidar.h"
#include "hal/sweep.h"
#include "realtime/sync/clock_line.h"

namespace sparsight {

struct LidarBufferConfig {
  std::size_t packets = 640;  // 0.85 s of single, 0.42 s of dual returns
  std::chrono::nanoseconds longest_turn{250'000'000};
  std::chrono::nanoseconds oldest{250'000'000};  // before the exposure, of the newest firing
};

enum class SweepOutcome : std::uint8_t {
  kWhole,    // a full turn of the head
  kPartial,  // less had been received
  kNoPackets,
  kTooOld,  // the newest packet is far from the exposure
};

// Decoded packets of the last while, from which the returns around an exposure are cut. A ring of
// fixed length whose packets keep their memory; thread-bound.
class LidarBuffer {
 public:
  explicit LidarBuffer(const LidarBufferConfig& config = {});

  // Takes the packet's returns and leaves it other memory to be filled.
  void add(DecodedPacket& packet);

  // The last full turn of the head among what had arrived by `ready`: cut at the firing, ring by
  // ring, along a ring in the order of firing. Only packets of the newest epoch count.
  SweepOutcome sweep(HostTime ready, const ClockLine& clock, HostTime exposure, Sweep& out) const;

 private:
  struct Turn;

  const DecodedPacket& from_newest(std::size_t age) const;
  std::chrono::nanoseconds length_of(std::size_t age) const;
  Turn turn_before(std::size_t newest) const;
  template <typename Visit>
  void for_each(const Turn& turn, Visit&& visit) const;

  LidarBufferConfig config_;
  std::vector<DecodedPacket> ring_;
  std::size_t added_ = 0;
};

}  // namespace sparsight
