#include "realtime/pipeline/tracking_runner.h"

#include <gtest/gtest.h>

#include <memory>

#include "realtime/executor/thread_setup.h"
#include "slam/window_stage.h"
#include "tests/realtime/executor/fake_clock.h"
#include "tests/realtime/guard/realtime_guard.h"
#include "tests/slam/room_rig.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::nanoseconds kRoomPeriod = 100ms;

// The tracking thread's rounds, one by one, with the other stages played by the test.
class Rounds {
 public:
  Rounds()
      : config_(config()),
        stage_(rig_.calibration(), config_),
        window_(rig_.calibration(), config_),
        runner_(stage_, kRoomPeriod, shared, clock) {
    for (LiveFrame& frame : shared.frames) {
      stage_.prepare(frame.tracked);
      free_.push_back(&frame);
    }
  }

  static OdometryConfig config() {
    OdometryConfig config = room_config();
    config.photometry.affine_brightness = true;
    config.photometry.patch_weights = true;
    config.tracker.automatic_top_level = true;
    config.tracker.scan_speed = true;
    config.keyframes.max_age_s = 0.45;
    return config;
  }

  // The frame is put together as the synchronisation does: with memory of its own.
  void arrive(int i, const SynchronizedFrame& frame) {
    reclaim();
    LiveFrame& slot = *free_.back();
    free_.pop_back();
    slot.frame = frame;
    slot.frame.sequence = static_cast<std::uint64_t>(i);
    slot.frame.exposure = clock.now() - 10ms;
    slot.arrival = slot.ready = clock.now();
    ASSERT_TRUE(shared.to_tracking.producer().try_push(&slot));
  }
  void arrive(int i) { arrive(i, rig_.frame(i)); }

  bool tick() { return runner_.tick(); }

  // What the window's thread does; `optimized` says how far.
  void run_window(bool optimized = true) {
    LiveFrame* frame = nullptr;
    while (shared.to_window.consumer().try_pop(frame)) {
      const bool accepted = window_.accept(frame->frame, frame->tracked);
      free_.push_back(frame);
      publish();
      if (!accepted || !optimized) continue;
      window_.optimize();
      publish();
    }
  }

  LiveRecord last_record() {
    LiveRecord record;
    LiveRecord last;
    while (shared.records.consumer().try_pop(record)) last = record;
    return last;
  }
  const RoomRig& rig() const { return rig_; }

  FakeClock clock;
  LiveShared shared{8};

 private:
  void publish() {
    window_.describe(shared.reference.draft());
    shared.reference.publish();
  }
  void reclaim() {
    LiveFrame* frame = nullptr;
    while (shared.free_from_tracking.consumer().try_pop(frame)) free_.push_back(frame);
  }

  RoomRig rig_;
  OdometryConfig config_;
  TrackingStage stage_;
  WindowStage window_;
  TrackingRunner runner_;
  std::vector<LiveFrame*> free_;
};

// The heart of it: once it runs, tracking does nothing that could make it wait.
TEST(TrackingRunner, DoesNothingInSteadyStateThatARealTimeThreadMustNot) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "not under a sanitizer";
  set_up_thread({.name = "tracking"});  // its stack has been touched
  Rounds rounds;
  int keyframes = 0;
  int searches = 0;
  for (int i = 0; i < 24; ++i) {
    // A frame without an image, and two from elsewhere that every starting motion is tried for.
    SynchronizedFrame frame = rounds.rig().frame(i);
    if (i == 14) frame.grey = {};
    if (i == 17 || i == 21) frame.grey = rounds.rig().frame(0).grey;
    rounds.arrive(i, frame);
    RealtimeOffences found;
    {
      const RealtimeGuard guard;
      rounds.tick();
      found = guard.offences();
    }
    const LiveRecord record = rounds.last_record();
    ASSERT_EQ(record.sequence, static_cast<std::uint64_t>(i));
    keyframes += record.outcome.becomes_keyframe;
    searches += record.outcome.tracking.attempts > 1;
    rounds.run_window();
    if (i < 4) continue;  // the first rounds touch each buffer once
    EXPECT_EQ(found.allocations, 0) << "frame " << i;
    EXPECT_EQ(found.locks, 0) << "frame " << i;
    EXPECT_EQ(found.file_calls, 0) << "frame " << i;
    EXPECT_EQ(found.system_calls, 0) << "frame " << i;
    EXPECT_EQ(found.page_faults, 0) << "frame " << i;
  }
  EXPECT_GE(keyframes, 5) << "handing over is part of it";
  EXPECT_GE(searches, 3) << "so is looking for a frame that is not where it was expected";
  EXPECT_GT(rounds.shared.counters.frames_tracked, 20U);
}

TEST(TrackingRunner, TracksOnAgainstTheOldKeyframeWhileTheWindowIsBusy) {
  Rounds rounds;
  for (int i = 0; i < 4; ++i) {
    rounds.arrive(i);
    rounds.tick();
    rounds.run_window();
  }
  int handed_over = 0;
  for (int i = 4; i < 12; ++i) {
    rounds.arrive(i);
    rounds.tick();
    const LiveRecord record = rounds.last_record();
    EXPECT_EQ(record.outcome.status, FrameOutcome::Status::kTracked) << i;
    EXPECT_LT(shift_between(record.outcome.T_world_camera, rounds.rig().T_world_camera(i)), 0.01);
    handed_over += record.outcome.becomes_keyframe;
  }
  EXPECT_EQ(handed_over, 1) << "one at a time: the window says when it has considered it";
  // Its word is late by several frames; tracking goes over to the new keyframe without a jump.
  rounds.run_window(false);
  rounds.arrive(12);
  rounds.tick();
  const LiveRecord record = rounds.last_record();
  EXPECT_EQ(record.outcome.status, FrameOutcome::Status::kTracked);
  EXPECT_GE(record.outcome.keyframe_sequence, 4U);
  EXPECT_EQ(record.outcome.tracking.attempts, 1) << "its motion and brightness came along";
  EXPECT_LT(shift_between(record.outcome.T_world_camera, rounds.rig().T_world_camera(12)), 0.01);
}

TEST(TrackingRunner, LooksAgainForAFrameThatIsALittleLateAndGoesOnWithoutOneThatIsNotThere) {
  Rounds rounds;
  rounds.arrive(0);
  EXPECT_TRUE(rounds.tick());
  const HostTime before = rounds.clock.now();
  EXPECT_FALSE(rounds.tick());
  const auto waited = rounds.clock.now() - before;
  EXPECT_GE(waited, kRoomPeriod);
  EXPECT_LE(waited, kRoomPeriod * 7 / 4 + 2ms) << "it never waits into the next frame's time";
}

TEST(TrackingRunner, LeavesToTheNextTickWhatCameWhileAnotherThreadHadTheProcessor) {
  Rounds rounds;
  rounds.arrive(0);
  rounds.tick();
  // It looks for frame 1, which comes late; putting it together keeps this thread from running.
  int sleeps = 0;
  rounds.clock.after_sleep = [&] {
    if (++sleeps != 3) return;
    rounds.clock.advance(90ms);
    rounds.arrive(1);
  };
  EXPECT_FALSE(rounds.tick());
  EXPECT_TRUE(rounds.tick());
  EXPECT_EQ(rounds.last_record().sequence, 1U);
  EXPECT_EQ(rounds.shared.counters.deadlines_missed, 0U);
}

TEST(TrackingRunner, CountsAMissedDeadlineAndEveryFrameOfABacklog) {
  Rounds rounds;
  rounds.arrive(0);
  rounds.tick();
  rounds.run_window();
  bool slow = true;
  rounds.shared.probe = [&](LiveStage) {
    if (std::exchange(slow, false)) rounds.clock.advance(170ms);
  };
  rounds.arrive(1);
  rounds.tick();
  EXPECT_EQ(rounds.shared.counters.deadlines_missed, 1U);
  rounds.run_window();
  rounds.arrive(2);
  rounds.arrive(3);
  rounds.tick();
  EXPECT_EQ(rounds.last_record().sequence, 3U);
  EXPECT_EQ(rounds.shared.counters.deadlines_missed, 1U);
  EXPECT_GE(rounds.shared.counters.tracking_behind, 2U);
}

// A frame from elsewhere, of which every starting motion is to be tried.
LiveRecord searched(Rounds& rounds, std::chrono::nanoseconds each_step,
                    std::chrono::nanoseconds late) {
  constexpr int kFrame = 17;
  for (int i = 0; i < kFrame; ++i) {
    rounds.arrive(i);
    rounds.tick();
    rounds.run_window();
  }
  SynchronizedFrame elsewhere = rounds.rig().frame(kFrame);
  elsewhere.grey = rounds.rig().frame(0).grey;
  rounds.shared.probe = [&rounds, each_step, late](LiveStage) {
    rounds.clock.advance(late);
    rounds.clock.each_look = each_step;
  };
  rounds.arrive(kFrame, elsewhere);
  rounds.tick();
  return rounds.last_record();
}

TEST(TrackingRunner, SearchesAsLongAsTheFrameHasTime) {
  Rounds at_leisure;
  const LiveRecord whole = searched(at_leisure, 0ms, 0ms);
  ASSERT_GT(whole.outcome.tracking.attempts, 30);
  EXPECT_EQ(at_leisure.shared.counters.pose_searches_cut, 0U);

  Rounds slow;
  const LiveRecord cut = searched(slow, 2ms, 40ms);
  EXPECT_GT(cut.outcome.tracking.attempts, 5);
  EXPECT_LT(cut.outcome.tracking.attempts, 30);
  EXPECT_EQ(slow.shared.counters.pose_searches_cut, 1U);
  EXPECT_EQ(slow.shared.counters.deadlines_missed, 0U);
}

TEST(TrackingRunner, DoesNotBeginASearchForAFrameThatIsNearlyLate) {
  Rounds rounds;
  const LiveRecord record = searched(rounds, 0ms, kRoomPeriod - 5ms);
  EXPECT_EQ(record.outcome.tracking.attempts, 1);
  EXPECT_EQ(rounds.shared.counters.pose_searches_cut, 1U);
  EXPECT_EQ(rounds.shared.counters.deadlines_missed, 0U);
}

TEST(TrackingRunner, EndsAtACoarserLevelWhenTimeIsShort) {
  Rounds rounds;
  for (int i = 0; i < 6; ++i) {
    rounds.arrive(i);
    rounds.tick();
    rounds.run_window();
  }
  rounds.shared.rung = Shed::kTrackingLevels;
  rounds.arrive(6);
  rounds.tick();
  EXPECT_EQ(rounds.shared.counters.frames_coarse, 1U);
  const LiveRecord record = rounds.last_record();
  EXPECT_EQ(record.outcome.status, FrameOutcome::Status::kTracked);
  EXPECT_LT(shift_between(record.outcome.T_world_camera, rounds.rig().T_world_camera(6)), 0.02);
}

}  // namespace
}  // namespace sparsight
