#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "realtime/executor/latency_histogram.h"
#include "realtime/executor/latest_value.h"
#include "realtime/executor/spsc_queue.h"
#include "realtime/pipeline/live_messages.h"
#include "realtime/pipeline/overload.h"
#include "slam/tracking_reference.h"

namespace sparsight {

enum class LiveStage : std::uint8_t { kTracking, kWindow, kJournal, kBackground };

// What the stages of the live pipeline share, and all they share. Every queue has one thread at
// each end; its capacity is what docs/architecture.md says.
struct LiveShared {
  explicit LiveShared(std::size_t frames_in_flight)
      : frames(frames_in_flight),
        free_from_tracking(frames_in_flight),
        free_from_window(frames_in_flight),
        to_tracking(frames_in_flight),
        to_window(frames_in_flight) {}

  std::vector<LiveFrame> frames;               // all there are; the queues hold pointers to them
  SpscQueue<LiveFrame*> free_from_tracking;    // tracking → sync
  SpscQueue<LiveFrame*> free_from_window;      // window → sync
  SpscQueue<LiveFrame*> to_tracking;           // sync → tracking
  SpscQueue<LiveFrame*> to_window;             // tracking → window
  SpscQueue<LiveRecord> records{256};          // tracking → journal
  SpscQueue<FrameFaults> faults{256};          // sync → journal
  SpscQueue<WindowReport> window_reports{64};  // window → journal
  SpscQueue<SettledPose> settled{64};          // window → journal
  SpscQueue<RetiredKeyframe> retired{64};      // window → background
  LatestValue<TrackingReference> reference;    // window → tracking
  LatestValue<LivePose> pose;                  // tracking → whoever shows the state
  LatestValue<MapPlace> map_for_journal;       // background → journal
  LatestValue<MapPlace> map_for_state;         // background → whoever shows the state

  // Relaxed counters: each stands for itself.
  struct Counters {
    std::atomic<std::uint64_t> frames_ready{0};
    std::atomic<std::uint64_t> frames_dropped{0};  // by us: no free one to put them in
    std::atomic<std::uint64_t> frames_tracked{0};
    std::atomic<std::uint64_t> frames_predicted{0};
    std::atomic<std::uint64_t> frames_lost{0};
    std::atomic<std::uint64_t> keyframes{0};
    std::atomic<std::uint64_t> deadlines_missed{
        0};  // tracking was not done when the next tick was due
    std::atomic<std::uint64_t> records_dropped{0};  // of the journal
    std::atomic<std::uint64_t> frames_coarse{0};    // work left out, by rung
    std::atomic<std::uint64_t> windows_shortened{0};
    std::atomic<std::uint64_t> searches_left_out{0};
    std::atomic<std::uint64_t> pose_searches_cut{0};  // no rung: a search keeps to its time
    std::atomic<std::uint64_t> previews_left_out{0};
    std::atomic<std::uint64_t> tracking_behind{0};  // signs of overload
    std::atomic<std::uint64_t> window_behind{0};
    std::atomic<std::uint64_t> background_behind{0};
  } counters;
  static void count(std::atomic<std::uint64_t>& counter) noexcept {
    counter.fetch_add(1, std::memory_order_relaxed);
  }

  std::atomic<Shed> rung{Shed::kNothing};
  bool sheds(Shed what) const noexcept { return rung.load(std::memory_order_relaxed) >= what; }
  std::atomic<bool> phase_locked{false};
  std::atomic<std::int64_t> last_ready_ns{0};

  LatencyHistogram wake_up;
  LatencyHistogram tracking_time;
  LatencyHistogram window_time;
  LatencyHistogram exposure_to_pose;
  LatencyHistogram arrival_to_pose;

  // Called by each stage as it begins a piece of work: where a test makes it slow.
  std::function<void(LiveStage)> probe;
  bool track = true;  // false: frames are counted, and go no further
};

}  // namespace sparsight
