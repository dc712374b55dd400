#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "hal/result.h"
#include "hal/rig_event.h"

namespace sparsight {

// Of what has content, a frame's picture or a packet's payload: byte by byte, told by a hash of 64
// bits. One that came out twice, out of its order or altered counts as foreign.
struct ContentComparison {
  std::uint64_t in = 0;
  std::uint64_t out = 0;
  std::uint64_t equal = 0;    // came out as it went in
  std::uint64_t missing = 0;  // went in and did not come out
  std::uint64_t foreign = 0;  // came out and had not gone in

  bool all_equal() const { return in > 0 && equal == in && missing == 0 && foreign == 0; }
};

// Of edges: those that came out within 2 ms of when they went in, and by how much they were late.
struct EdgeComparison {
  std::uint64_t in = 0;
  std::uint64_t out = 0;
  std::uint64_t matched = 0;
  std::chrono::nanoseconds median_late{0};
  std::chrono::nanoseconds most_late{0};   // largest
  std::chrono::nanoseconds least_late{0};  // smallest; below 0: came out before it went in
};

struct RecordingComparison {
  ContentComparison frames;
  ContentComparison packets;
  ContentComparison positions;
  EdgeComparison exposures;  // both edges, as both are watched
  EdgeComparison pulses;     // PPS: rising ones, as only these are watched
  // From a frame's stamp as it was played to the stamp that came out, largest.
  std::chrono::nanoseconds worst_frame_stamp{0};
  std::uint32_t camera_starts = 0;  // of the recording that came out
  std::uint64_t sequence_gaps = 0;  // frames that its camera's count says were lost
};

// What went into a rig's devices against what was recorded from them; `moved_by` is what the
// player says of the times. Reads both once; keeps hashes, not frames.
Result<RecordingComparison> compare_recordings(const std::string& in, const std::string& out,
                                               std::chrono::nanoseconds moved_by);
// The same on sources.
RecordingComparison compare_events(RigEventSource& in, RigEventSource& out,
                                   std::chrono::nanoseconds moved_by);

}  // namespace sparsight
