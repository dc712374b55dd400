#include "realtime/sync/exposure_pairing.h"

#include <utility>

namespace sparsight {

std::optional<ExposureMark> ExposurePairing::add(const Edge& edge) {
  if (exposure_active_) return edge.rising ? begin(edge.time) : end(edge.time);
  if (!edge.rising) return std::nullopt;
  return ExposureMark{.time = edge.time};
}

std::optional<ExposureMark> ExposurePairing::begin(HostTime time) {
  const std::optional<HostTime> unfinished = std::exchange(rise_, time);
  if (!unfinished || !half_length_) return std::nullopt;
  return ExposureMark{
      .time = *unfinished + *half_length_, .half_length = *half_length_, .doubtful = true};
}

std::optional<ExposureMark> ExposurePairing::end(HostTime time) {
  const std::optional<HostTime> rise = std::exchange(rise_, std::nullopt);
  if (rise && *rise < time) {
    half_length_ = (time - *rise) / 2;
    return ExposureMark{.time = *rise + *half_length_, .half_length = *half_length_};
  }
  if (!half_length_) return std::nullopt;
  return ExposureMark{.time = time - *half_length_, .half_length = *half_length_, .doubtful = true};
}

}  // namespace sparsight
