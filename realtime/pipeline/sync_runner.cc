#include "realtime/pipeline/sync_runner.h"

#include <utility>

#include "realtime/executor/fixed_rate_loop.h"

namespace sparsight {
namespace {

constexpr std::chrono::nanoseconds kSyncRound{1'000'000};
constexpr std::chrono::nanoseconds kPublishPeriod{100'000'000};
// At the end, for a frame to become free: two seconds, then tracking is no more.
constexpr int kMostDrainingRounds = 2000;

}  // namespace

SyncRunner::SyncRunner(std::array<SpscQueue<RigEvent>*, kDevices> devices,
                       std::unique_ptr<Synchronizer> synchronizer, LiveShared& shared,
                       LoopClock& clock)
    : devices_(devices), synchronizer_(std::move(synchronizer)), shared_(shared), clock_(clock) {}

void SyncRunner::run(StageThread& thread) {
  FixedRateLoop loop(clock_, kSyncRound, clock_.now() + kSyncRound);
  for (;;) {
    const bool last = thread.stopping();
    const LoopTick tick = loop.wait();
    thread.beat();
    drain();
    publish(tick.woke);
    if (last) break;
  }
  draining_ = true;
  synchronizer_->finish();
  forward();
  publish(clock_.now() + kPublishPeriod);
}

// Whose next event is the oldest; null if there is none.
SpscQueue<RigEvent>* SyncRunner::earliest() {
  SpscQueue<RigEvent>* first = nullptr;
  HostTime arrival = HostTime::max();
  for (SpscQueue<RigEvent>* queue : devices_) {
    const RigEvent* event = queue->consumer().front();
    if (event == nullptr) continue;
    const HostTime at = arrival_of(*event);
    if (first != nullptr && at >= arrival) continue;
    arrival = at;
    first = queue;
  }
  return first;
}

void SyncRunner::drain() {
  RigEvent event;
  while (SpscQueue<RigEvent>* queue = earliest()) {
    queue->consumer().try_pop(event);
    synchronizer_->add(event);
    forward();
  }
}

LiveFrame* SyncRunner::free_frame() {
  LiveFrame* frame = std::exchange(free_, nullptr);
  if (frame == nullptr) shared_.free_from_tracking.consumer().try_pop(frame);
  if (frame == nullptr) shared_.free_from_window.consumer().try_pop(frame);
  return frame;
}

void SyncRunner::forward() {
  while (auto bundled = synchronizer_->take()) {
    if (!shared_.track) {
      LiveShared::count(shared_.counters.frames_ready);
      continue;
    }
    LiveFrame* frame = free_frame();
    for (int rounds = 0; frame == nullptr && draining_ && rounds < kMostDrainingRounds; ++rounds) {
      clock_.sleep_until(clock_.now() + kSyncRound);
      frame = free_frame();
    }
    if (frame == nullptr) {
      LiveShared::count(shared_.counters.frames_dropped);
      continue;
    }
    FrameFaults faults{bundled->frame.sequence, std::move(bundled->frame.faults)};
    if (!faults.faults.empty()) shared_.faults.producer().try_push(std::move(faults));
    frame->frame = std::move(bundled->frame);
    frame->arrival = bundled->stamp.arrival;
    frame->ready = clock_.now();
    shared_.last_ready_ns.store(frame->ready.time_since_epoch().count(), std::memory_order_relaxed);
    LiveShared::count(shared_.counters.frames_ready);
    // There is room: the queue takes as many frames as there are.
    if (!shared_.to_tracking.producer().try_push(frame)) free_ = frame;
  }
}

void SyncRunner::publish(HostTime now) {
  if (now - last_published_ < kPublishPeriod) return;
  last_published_ = now;
  state_.draft() = synchronizer_->state();
  state_.publish();
}

}  // namespace sparsight
