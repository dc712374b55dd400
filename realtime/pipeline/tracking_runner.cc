#include "realtime/pipeline/tracking_runner.h"

#include <cstdint>

namespace sparsight {
namespace {

// A frame that is not there yet is looked for so often, until the next one is nearly due.
constexpr std::chrono::nanoseconds kFrameLookAgain{500'000};
constexpr double kWaitingShare = 0.75;
// What a round still has to do when a search has ended, and what may keep it from the processor.
constexpr std::chrono::nanoseconds kAfterSearch{1'000'000};

}  // namespace

TrackingRunner::TrackingRunner(TrackingStage& tracking, std::chrono::nanoseconds period,
                               LiveShared& shared, LoopClock& clock)
    : tracking_(tracking),
      shared_(shared),
      clock_(clock),
      loop_(clock, period, clock.now() + period),
      phase_(period),
      search_(clock) {
  search_.rehearse();
}

void TrackingRunner::run(StageThread& thread) {
  for (;;) {
    const bool last = thread.stopping();
    thread.beat();
    if (!tick() && last) return;
  }
}

bool TrackingRunner::tick() {
  const LoopTick tick = loop_.wait();
  if (!tick.overran) shared_.wake_up.add(tick.woke - tick.due);
  if (shared_.to_tracking.size() > 1 || tick.left_out > 0) {
    LiveShared::count(shared_.counters.tracking_behind);
  }
  bool any = track_waiting(tick.due);
  const HostTime patience =
      tick.due + std::chrono::nanoseconds(static_cast<std::int64_t>(
                     kWaitingShare * static_cast<double>(loop_.period().count())));
  while (!any && clock_.now() + kFrameLookAgain < patience) {
    clock_.sleep_until(clock_.now() + kFrameLookAgain);
    // Another thread may have had the processor for longer than that: then it is the next tick's,
    // or this round would end late, and every one after it at the same phase.
    if (clock_.now() < patience) any = track_waiting(tick.due);
  }
  loop_.shift(any ? phase_.observe(last_ready_, loop_.next()) : phase_.coast());
  shared_.phase_locked.store(phase_.locked(), std::memory_order_relaxed);
  return any;
}

bool TrackingRunner::track_waiting(HostTime due) {
  // What comes meanwhile is the next tick's: a round has an end however slow it is.
  std::size_t waiting = shared_.to_tracking.size();
  const bool any = waiting > 0;
  bool late = false;
  LiveFrame* frame = nullptr;
  for (; waiting > 0 && shared_.to_tracking.consumer().try_pop(frame); --waiting) {
    last_ready_ = frame->ready;
    const HostTime deadline = due + loop_.period();
    const HostTime now = clock_.now();
    // Frames of a backlog share what is left of the round.
    track(*frame, now + (deadline - now) / static_cast<std::int64_t>(waiting));
    late = clock_.now() > deadline;
    if (late) LiveShared::count(shared_.counters.tracking_behind);
  }
  if (late) LiveShared::count(shared_.counters.deadlines_missed);
  return any;
}

void TrackingRunner::track(LiveFrame& frame, HostTime deadline) {
  const HostTime begun = clock_.now();
  if (shared_.probe) shared_.probe(LiveStage::kTracking);
  const bool coarse = shared_.sheds(Shed::kTrackingLevels);
  if (coarse) LiveShared::count(shared_.counters.frames_coarse);
  shared_.reference.refresh();
  search_.begin(deadline - kAfterSearch);
  tracking_.track(frame.frame, shared_.reference.value(), frame.tracked, coarse ? 1 : 0, &search_);
  if (search_.end()) LiveShared::count(shared_.counters.pose_searches_cut);
  const HostTime done = clock_.now();
  journal(frame, begun, done);
  if (frame.tracked.outcome.becomes_keyframe) {
    frame.handed_over = done;
    shared_.to_window.producer().try_push(&frame);  // room for as many as there are
  } else {
    shared_.free_from_tracking.producer().try_push(&frame);
  }
}

void TrackingRunner::journal(const LiveFrame& frame, HostTime begun, HostTime done) {
  const FrameOutcome& outcome = frame.tracked.outcome;
  shared_.tracking_time.add(done - begun);
  shared_.exposure_to_pose.add(done - frame.frame.exposure);
  shared_.arrival_to_pose.add(done - frame.arrival);
  LiveShared::Counters& counters = shared_.counters;
  switch (outcome.status) {
    case FrameOutcome::Status::kTracked:
    case FrameOutcome::Status::kFirst:
      LiveShared::count(counters.frames_tracked);
      break;
    case FrameOutcome::Status::kPredicted:
      LiveShared::count(counters.frames_predicted);
      break;
    case FrameOutcome::Status::kLost:
      LiveShared::count(counters.frames_lost);
      break;
  }
  shared_.pose.draft() = {frame.frame.exposure, outcome.T_world_camera, outcome.status,
                          outcome.submap};
  shared_.pose.publish();
  const LiveRecord record{.sequence = frame.frame.sequence,
                          .exposure = frame.frame.exposure,
                          .done = done,
                          .outcome = outcome,
                          .tracking_time = done - begun};
  if (!shared_.records.producer().try_push(record)) LiveShared::count(counters.records_dropped);
}

}  // namespace sparsight
