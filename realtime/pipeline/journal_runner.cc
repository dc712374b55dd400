#include "realtime/pipeline/journal_runner.h"

#include <utility>

namespace sparsight {
namespace {

constexpr std::chrono::nanoseconds kJournalRound{5'000'000};
constexpr std::chrono::nanoseconds kJournalPatience{300'000'000};  // then the journal is behind
// So long a keyframe's row waits for its window's time: half a second of frames.
constexpr std::size_t kMostRowsHeld = 15;

}  // namespace

void JournalRunner::run(StageThread& thread) {
  for (bool last = false;;) {
    last = thread.stopping();
    thread.beat();
    record_events();
    take_records();
    write_rows(last);
    if (last) return;
    clock_.sleep_until(clock_.now() + kJournalRound);
  }
}

void JournalRunner::record_events() {
  RigEvent event;
  for (SpscQueue<RigEvent>* queue : devices_) {
    while (queue->consumer().try_pop(event)) {
      if (outputs_.on_event) outputs_.on_event(std::move(event));
    }
  }
}

void JournalRunner::take_records() {
  LiveRecord record;
  bool late = false;
  while (shared_.records.consumer().try_pop(record)) {
    late = late || clock_.now() - record.done > kJournalPatience;
    preview(record);
    rows_.push_back(record);
    trajectory_.add(record.sequence, record.exposure, record.outcome);
  }
  if (late) LiveShared::count(shared_.counters.background_behind);
  WindowReport report;
  while (shared_.window_reports.consumer().try_pop(report)) reports_.push_back(report);
  SettledPose settled;
  while (shared_.settled.consumer().try_pop(settled)) {
    trajectory_.settle(settled.keyframe, settled.T_world_camera);
  }
}

void JournalRunner::preview(const LiveRecord& record) {
  if (shared_.sheds(Shed::kPreview)) {
    LiveShared::count(shared_.counters.previews_left_out);
    return;
  }
  if (shared_.probe) shared_.probe(LiveStage::kJournal);
  if (!outputs_.on_preview) return;
  shared_.map_for_journal.refresh();
  const MapPlace& map = shared_.map_for_journal.value();
  const FrameOutcome& outcome = record.outcome;
  outputs_.on_preview(
      {.pose = {record.exposure, outcome.T_world_camera, outcome.status, outcome.submap},
       .T_map_world = map.T_map_world,
       .placed = in_its_place(map, outcome.submap)});
}

void JournalRunner::write_rows(bool all) {
  while (!rows_.empty()) {
    const LiveRecord& row = rows_.front();
    std::chrono::nanoseconds window_time{0};
    if (row.outcome.becomes_keyframe) {
      while (!reports_.empty() && reports_.front().sequence < row.sequence) reports_.pop_front();
      const bool known = !reports_.empty() && reports_.front().sequence == row.sequence;
      if (!known && !all && rows_.size() <= kMostRowsHeld) return;
      if (known) window_time = reports_.front().window_time;
    }
    write_row(row, window_time);
    rows_.pop_front();
  }
}

void JournalRunner::write_row(const LiveRecord& row, std::chrono::nanoseconds window_time) {
  FrameRecord record{.sequence = row.sequence,
                     .exposure = row.exposure,
                     .outcome = row.outcome,
                     .tracking_time = row.tracking_time,
                     .window_time = window_time,
                     .faults = faults_of(row.sequence)};
  if (outputs_.on_frame) outputs_.on_frame(std::move(record));
}

// Faults of frames that never came to be tracked are told with the next that was.
std::vector<Error> JournalRunner::faults_of(std::uint64_t sequence) {
  std::vector<Error> result;
  auto queue = shared_.faults.consumer();
  for (FrameFaults* next = queue.front(); next != nullptr && next->sequence <= sequence;
       next = queue.front()) {
    FrameFaults faults;
    queue.try_pop(faults);
    for (Error& fault : faults.faults) result.push_back(std::move(fault));
  }
  return result;
}

}  // namespace sparsight
