#include "tools/playback/playback_faults.h"

#include <variant>

namespace sparsight {

DeviceKind device_of(const RigEvent& event) {
  if (const auto* change = std::get_if<DeviceStateChange>(&event)) return change->device;
  if (std::holds_alternative<Edge>(event)) return DeviceKind::kTrigger;
  const bool frame = std::holds_alternative<std::shared_ptr<const CameraFrame>>(event);
  return frame ? DeviceKind::kCamera : DeviceKind::kLidar;
}

bool PlaybackFaults::withhold(const RigEvent& event) {
  const auto* edge = std::get_if<Edge>(&event);
  const bool lost = edge && loses(*edge);
  return lost || plan_.away(device_of(event), arrival_of(event) - first_);
}

bool PlaybackFaults::loses(const Edge& edge) {
  if (edge.line != EdgeLine::kExposure) return false;
  if (edge.rising) ++exposures_;
  return plan_.loses_edge(exposures_);
}

}  // namespace sparsight
