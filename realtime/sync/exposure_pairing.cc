#include "realtime/sync/exposure_pairing.h"

#include <utility>

namespace sparsight {

std::optional<ExposureMark> ExposurePairing::add(const Edge& edge) {
  if (exposure_active_) return edge.rising ? begin(edge.time) : end(edge.time);
  if (!edge.rising) return std::nullopt;
  return ExposureMark{.start = edge.time};
}

std::optional<ExposureMark> ExposurePairing::begin(HostTime time) {
  const std::optional<HostTime> unfinished = std::exchange(rise_, time);
  // Soon after another rise one of the two is a glitch; later a fall between them was lost.
  rise_doubtful_ = unfinished && (!length_ || time - *unfinished < 2 * *length_);
  if (unfinished) ++incomplete_;
  if (!unfinished || !length_) return std::nullopt;
  return ExposureMark{.start = *unfinished, .length = *length_, .doubtful = true};
}

std::optional<ExposureMark> ExposurePairing::end(HostTime time) {
  const std::optional<HostTime> rise = std::exchange(rise_, std::nullopt);
  if (rise && *rise < time) {
    const ExposureMark mark{.start = *rise, .length = time - *rise, .doubtful = rise_doubtful_};
    if (!mark.doubtful) length_ = mark.length;
    return mark;
  }
  ++incomplete_;
  if (!length_) return std::nullopt;
  return ExposureMark{.start = time - *length_, .length = *length_, .doubtful = true};
}

}  // namespace sparsight
