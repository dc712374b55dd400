#pragma once

#include <cstddef>

#include "hal/result.h"
#include "tools/evaluation/session_loops.h"
#include "tools/evaluation/trajectory.h"

namespace sparsight {

struct LoopErrorOptions {
  // A loop is false that is off by more: not two views of one place, or not where it says.
  double max_error_m = 0.1;
  double max_error_deg = 1.0;
  // The true path passes a place again where a keyframe stands so near an earlier one, which is not
  // among the last before it, or of another sub-map.
  double revisit_m = 1.0;
  double revisit_deg = 20.0;
  std::size_t recent_keyframes = 30;
};

// How far the loops of a session can be trusted, and how many of those there are it has found.
struct LoopError {
  std::size_t loops = 0;  // that stand
  std::size_t false_loops = 0;
  double max_error_m = 0.0;
  double max_error_deg = 0.0;
  std::size_t keyframes = 0;
  std::size_t revisits = 0;  // keyframes that pass a place again
  std::size_t closed = 0;    // of them, those with a loop
  std::size_t submaps = 0;
  std::size_t joined = 0;            // to an earlier one
  std::size_t joined_falsely = 0;    // by a false loop
  std::size_t with_earlier_map = 0;  // not judged: loops with frames of another session
};

// Where the ground truth has no times it is one of the session's frames, in their order.
Result<LoopError> loop_error(const SessionLoops& session, const Trajectory& truth,
                             const LoopErrorOptions& options);

}  // namespace sparsight
