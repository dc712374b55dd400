#include "realtime/pipeline/background_runner.h"

#include <utility>

namespace sparsight {
namespace {

constexpr std::chrono::nanoseconds kBackgroundRound{10'000'000};
constexpr std::size_t kMostWaiting = 3;  // keyframes; with more it is behind

}  // namespace

void BackgroundRunner::run(StageThread& thread) {
  RetiredKeyframe keyframe;
  for (;;) {
    const bool last = thread.stopping();
    thread.beat();
    if (!last && shared_.retired.size() > kMostWaiting) {
      LiveShared::count(shared_.counters.background_behind);
    }
    if (shared_.retired.consumer().try_pop(keyframe)) {
      take(std::move(keyframe));
      continue;
    }
    if (last) return;
    clock_.sleep_until(clock_.now() + kBackgroundRound);
  }
}

void BackgroundRunner::take(RetiredKeyframe&& keyframe) {
  if (shared_.probe) shared_.probe(LiveStage::kBackground);
  const KeyframeEffort effort{.search_loops = !shared_.sheds(Shed::kLoopSearch)};
  if (!effort.search_loops) LiveShared::count(shared_.counters.searches_left_out);
  if (!outputs_.on_keyframe) return;
  const MapPlace place = outputs_.on_keyframe(std::move(keyframe), effort);
  for (LatestValue<MapPlace>* reader : {&shared_.map_for_journal, &shared_.map_for_state}) {
    reader->draft() = place;
    reader->publish();
  }
}

}  // namespace sparsight
