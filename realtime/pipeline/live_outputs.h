#pragma once

#include <functional>

#include "hal/rig_event.h"
#include "realtime/pipeline/frame_record.h"
#include "realtime/pipeline/live_messages.h"
#include "slam/retired_keyframe.h"

namespace sparsight {

// How much may be done for a keyframe now.
struct KeyframeEffort {
  bool search_loops = true;  // false in want of time: keep it, compare it with no old place
};

// Where the live pipeline's results go. What is not set is not given out.
struct LiveOutputs {
  // On the journal's thread. Everything raw, of each device in its order.
  std::function<void(RigEvent&&)> on_event;
  // Every frame, in order; a keyframe's with the time its window took.
  std::function<void(FrameRecord&&)> on_frame;
  // For those who watch; left out when time is short.
  std::function<void(const LivePreview&)> on_preview;

  // On the background thread: keyframes whose pose is final for the odometry, oldest first. Loop
  // closure and map take them; they may take their time. They say where the odometry's frame lies
  // in the map's from then on.
  std::function<MapPlace(RetiredKeyframe&&, const KeyframeEffort&)> on_keyframe;
};

}  // namespace sparsight
