#include "hal/rig_event.h"

namespace sparsight {
namespace {

struct Arrival {
  HostTime operator()(const std::shared_ptr<const CameraFrame>& frame) const {
    return frame->arrival;
  }
  HostTime operator()(const Edge& edge) const { return edge.time; }
  HostTime operator()(const LidarPacket& packet) const { return packet.arrival; }
  HostTime operator()(const PositionPacket& packet) const { return packet.arrival; }
  HostTime operator()(const DeviceStateChange& change) const { return change.at; }
};

}  // namespace

HostTime arrival_of(const RigEvent& event) { return std::visit(Arrival{}, event); }

}  // namespace sparsight
