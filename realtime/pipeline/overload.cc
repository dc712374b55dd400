#include "realtime/pipeline/overload.h"

namespace sparsight {
namespace {

Shed highest_rung(const OverloadSigns& signs) {
  if (signs.tracking) return Shed::kTrackingLevels;
  if (signs.window) return Shed::kWindowIterations;
  return signs.background ? Shed::kLoopSearch : Shed::kNothing;
}

Shed moved(Shed rung, int by) { return static_cast<Shed>(static_cast<int>(rung) + by); }

}  // namespace

Shed OverloadLadder::look(HostTime now, const OverloadSigns& signs) {
  const Shed highest = highest_rung(signs);
  if (highest != Shed::kNothing) {
    calm_since_ = now;
    if (rung_ < highest) rung_ = moved(rung_, 1);
  } else if (rung_ != Shed::kNothing && now - calm_since_ >= config_.calm) {
    rung_ = moved(rung_, -1);
    calm_since_ = now;
  }
  return rung_;
}

}  // namespace sparsight
