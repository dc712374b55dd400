#include "realtime/pipeline/window_runner.h"

#include <utility>

namespace sparsight {
namespace {

constexpr std::chrono::nanoseconds kWindowRound{2'000'000};
// A frame that is to become a keyframe and waits longer says that the window is behind.
constexpr std::chrono::nanoseconds kWindowPatience{100'000'000};
// At the end, for the background to take what is left; longer, and it is no more.
constexpr std::chrono::nanoseconds kLastPatience{30'000'000'000};

}  // namespace

void WindowRunner::run(StageThread& thread) {
  LiveFrame* frame = nullptr;
  for (;;) {
    const bool last = thread.stopping();
    thread.beat();
    if (shared_.to_window.consumer().try_pop(frame)) {
      add(*frame);
      continue;
    }
    pass_on_retired();
    if (last) break;
    clock_.sleep_until(clock_.now() + kWindowRound);
  }
  window_.finish();
  const HostTime patience = clock_.now() + kLastPatience;
  for (pass_on_retired(); !retired_.empty() && clock_.now() < patience; pass_on_retired()) {
    thread.beat();
    clock_.sleep_until(clock_.now() + kWindowRound);
  }
}

void WindowRunner::add(LiveFrame& frame) {
  const HostTime begun = clock_.now();
  if (begun - frame.handed_over > kWindowPatience)
    LiveShared::count(shared_.counters.window_behind);
  const std::uint64_t sequence = frame.frame.sequence;
  const bool accepted = window_.accept(frame.frame, frame.tracked);
  shared_.free_from_window.producer().try_push(&frame);
  publish();
  if (accepted) {
    LiveShared::count(shared_.counters.keyframes);
    if (shared_.probe) shared_.probe(LiveStage::kWindow);
    const bool shorter = shared_.sheds(Shed::kWindowIterations);
    if (shorter) LiveShared::count(shared_.counters.windows_shortened);
    window_.optimize(shorter ? std::optional(fewer_iterations_) : std::nullopt);
    publish();
  }
  const auto took = clock_.now() - begun;
  shared_.window_time.add(took);
  shared_.window_reports.producer().try_push(WindowReport{sequence, took});
  pass_on_retired();
}

void WindowRunner::publish() {
  window_.describe(shared_.reference.draft());
  shared_.reference.publish();
}

void WindowRunner::pass_on_retired() {
  for (RetiredKeyframe& keyframe : window_.take_retired()) retired_.push_back(std::move(keyframe));
  while (!retired_.empty()) {
    const SettledPose settled{retired_.front().sequence, retired_.front().T_world_camera};
    if (shared_.settled.size() == shared_.settled.capacity()) return;
    if (!shared_.retired.producer().try_push(std::move(retired_.front()))) return;
    shared_.settled.producer().try_push(settled);
    retired_.pop_front();
  }
}

}  // namespace sparsight
