#include "realtime/executor/phase_lock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "realtime/executor/fixed_rate_loop.h"
#include "tests/realtime/executor/fake_clock.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kFramePeriod{33'333'333};

// A loop that follows a camera; how long after a frame each tick came.
class Follower {
 public:
  explicit Follower(double rate_error = 0.0)
      : frame_period_(static_cast<std::int64_t>(static_cast<double>(kFramePeriod.count()) *
                                                (1.0 + rate_error))) {}

  // The next frame comes `late` after its time; returns by how much the tick was after it.
  nanoseconds follow(nanoseconds late = 0ns) {
    next_frame_ += frame_period_;
    HostTime ready = next_frame_ + late;
    LoopTick tick = loop_.wait();
    while (tick.woke < ready) {  // not there yet: seen at the next tick
      loop_.shift(lock.coast());
      tick = loop_.wait();
    }
    while (tick.woke >= ready + frame_period_) {  // more than one was waiting
      next_frame_ += frame_period_;
      ready += frame_period_;
    }
    const nanoseconds after = tick.woke - ready;
    loop_.shift(lock.observe(ready, loop_.next()));
    return after;
  }
  void move_camera(nanoseconds by) { next_frame_ += by; }

  PhaseLock lock{kFramePeriod};

 private:
  FakeClock clock_;
  FixedRateLoop loop_{clock_, kFramePeriod, clock_.now() + 7ms};
  nanoseconds frame_period_;
  HostTime next_frame_ = clock_.now() + 20ms;
};

TEST(PhaseLock, WakesJustAfterTheFirstFrameHasToldThePhase) {
  Follower follower;
  follower.follow();
  for (int i = 0; i < 20; ++i) {
    const nanoseconds after = follower.follow();
    EXPECT_GE(after, 900us);
    EXPECT_LE(after, 1100us);
  }
  EXPECT_TRUE(follower.lock.locked());
}

TEST(PhaseLock, FollowsACameraWhoseRateIsNotQuiteTheOneGiven) {
  Follower follower(300e-6);  // 10 us a frame
  nanoseconds after{0};
  for (int i = 0; i < 600; ++i) after = follower.follow();
  EXPECT_NEAR(static_cast<double>(after.count()), 1e6, 2e5);
}

TEST(PhaseLock, IsNotPulledByAFrameThatIsLate) {
  Follower follower;
  for (int i = 0; i < 50; ++i) follower.follow();
  follower.follow(6ms);
  const nanoseconds after = follower.follow();
  EXPECT_GE(after, 900us);
  EXPECT_LE(after, 2500us) << "a little more margin, as frames may be late";
}

TEST(PhaseLock, KeepsAMarginThatGrowsWithJitterButNotWithoutBound) {
  Follower follower;
  std::mt19937 random(1);
  std::exponential_distribution<double> late_us(1.0 / 500.0);
  int missed = 0;
  for (int i = 0; i < 600; ++i) {
    const nanoseconds after = follower.follow(
        nanoseconds(static_cast<std::int64_t>(1e3 * std::min(late_us(random), 8000.0))));
    if (i >= 100 && after > 20ms) ++missed;
  }
  EXPECT_LE(missed, 40) << "of 500 frames that came after their tick";
  EXPECT_LE(follower.lock.margin(), 4ms);
  EXPECT_GT(follower.lock.margin(), 1ms);
}

TEST(PhaseLock, JumpsWhenTheCameraHasMovedForGood) {
  Follower follower;
  for (int i = 0; i < 50; ++i) follower.follow();
  follower.move_camera(15ms);
  for (int i = 0; i < 8; ++i) follower.follow();
  const nanoseconds after = follower.follow();
  EXPECT_GE(after, 500us);
  EXPECT_LE(after, 3ms);
}

}  // namespace
}  // namespace sparsight
