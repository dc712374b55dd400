#include "slam/points/sweep_motion.h"

namespace sparsight {

FiringSpan firing_span(const Sweep& sweep, std::size_t stride) {
  FiringSpan span;
  if (sweep.motion_compensated) return span;
  for (std::size_t i = 0; i < sweep.returns.size(); i += stride) {
    span.first_ns = std::min(span.first_ns, sweep.returns[i].from_exposure_ns);
    span.last_ns = std::max(span.last_ns, sweep.returns[i].from_exposure_ns);
  }
  return span;
}

}  // namespace sparsight
