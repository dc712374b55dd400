#pragma once

#include <chrono>
#include <cstdint>

#include "hal/time.h"

namespace sparsight {

// What is left out in want of time: each rung leaves out what those before it do, too. Raw
// recording stands on no rung.
enum class Shed : std::uint8_t {
  kNothing,
  kPreview,           // poses for those who watch
  kLoopSearch,        // keyframes are kept, and not compared with old places
  kWindowIterations,  // the window is optimised less thoroughly
  kTrackingLevels,    // frames are tracked to half the resolution
};

// Which stages are behind with their work.
struct OverloadSigns {
  bool background = false;
  bool window = false;
  bool tracking = false;
};

struct OverloadConfig {
  std::chrono::nanoseconds calm{2'000'000'000};  // without any sign, before a rung is given back
};

// Climbs one rung at a look while some stage is behind, in the order of the rungs: what hurts least
// is always left out first. No stage has work left out that is done after its own: the background
// stages climb to the loop search, the window to its iterations, tracking all the way. Comes down
// one rung after each calm while. Thread-bound.
class OverloadLadder {
 public:
  explicit OverloadLadder(const OverloadConfig& config = {}) : config_(config) {}

  Shed look(HostTime now, const OverloadSigns& signs);
  Shed rung() const { return rung_; }

 private:
  OverloadConfig config_;
  Shed rung_ = Shed::kNothing;
  HostTime calm_since_;
};

}  // namespace sparsight
