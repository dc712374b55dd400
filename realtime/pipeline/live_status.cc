#include "realtime/pipeline/live_status.h"

namespace sparsight {

const char* name_of(LiveState state) {
  switch (state) {
    case LiveState::kWaiting:
      return "waiting";
    case LiveState::kSynchronizing:
      return "synchronising";
    case LiveState::kTracking:
      return "tracking";
    case LiveState::kLost:
      return "lost";
    case LiveState::kRelocalizing:
      return "relocalising";
    case LiveState::kBlind:
      return "blind";
  }
  return "unknown";
}

const char* name_of(Shed shed) {
  switch (shed) {
    case Shed::kNothing:
      return "nothing";
    case Shed::kPreview:
      return "preview";
    case Shed::kLoopSearch:
      return "loop search";
    case Shed::kWindowIterations:
      return "window iterations";
    case Shed::kTrackingLevels:
      return "tracking levels";
  }
  return "unknown";
}

const char* name_of(DeviceState state) {
  switch (state) {
    case DeviceState::kStopped:
      return "stopped";
    case DeviceState::kStreaming:
      return "streaming";
    case DeviceState::kSilent:
      return "silent";
    case DeviceState::kGone:
      return "gone";
    case DeviceState::kEnded:
      return "ended";
  }
  return "unknown";
}

}  // namespace sparsight
