#include "realtime/sync/lidar_clock.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/realtime/sync/made_lidar.h"

namespace sparsight {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

// Feeds a clock from a made sensor and compares it with the truth.
class ClockRun {
 public:
  explicit ClockRun(const MadeLidarOptions& options) : lidar(options) {}

  void run(nanoseconds duration) {
    const SensorTime until = lidar.now() + duration;
    while (lidar.now() < until) {
      const SensorTime second(std::chrono::floor<seconds>(lidar.now().time_since_epoch()));
      const DecodedPacket packet = lidar.next();
      if (pps_wired && second != last_second_) {
        last_second_ = second;
        clock.add(lidar.pps(second));
      }
      if (reports) {
        clock.add(
            LidarClockReport{.arrival = packet.arrival, .time = packet.first_firing, .pps = pps});
      }
      clock.add(packet);
      note(packet);
    }
  }
  void forget_errors() { worst = nanoseconds(0); }

  MadeLidar lidar;
  LidarClock clock;
  bool pps_wired = false;
  bool reports = false;
  PpsState pps = PpsState::kAbsent;
  nanoseconds worst{0};
  double worst_in_sigmas = 0.0;

 private:
  void note(const DecodedPacket& packet) {
    const auto& mapping = clock.mapping();
    if (!mapping) return;
    const nanoseconds error = std::chrono::abs(mapping->line.at(packet.first_firing) -
                                               lidar.host_time(packet.first_firing));
    worst = std::max(worst, error);
    worst_in_sigmas =
        std::max(worst_in_sigmas, static_cast<double>(error.count()) /
                                      static_cast<double>(mapping->uncertainty.count()));
  }
  SensorTime last_second_{};
};

TEST(LidarClock, IsKnownToHalfAMillisecondTenSecondsAfterTheFirstPacket) {
  nanoseconds worst{0};
  for (unsigned seed = 1; seed <= 8; ++seed) {
    ClockRun run({.drift_ppm = seed % 2 == 0 ? 60.0 : -60.0,
                  .mean_delay_ns = seed <= 4 ? 200'000.0 : 1'000'000.0,
                  .rays = 0,
                  .seed = seed});
    run.run(seconds(10));
    run.forget_errors();
    run.run(seconds(10));
    worst = std::max(worst, run.worst);
    EXPECT_EQ(run.clock.state().source, LidarClockSource::kArrivals);
    EXPECT_EQ(run.clock.mapping()->quality, StampQuality::kEstimated);
    EXPECT_EQ(run.clock.state().restarts, 0U);
    EXPECT_NEAR(run.clock.state().drift_ppm, seed % 2 == 0 ? 60.0 : -60.0, 10.0);
  }
  RecordProperty("worst_ns", static_cast<int>(worst.count()));
  EXPECT_LT(worst, microseconds(100));  // of the 500 that are allowed
}

TEST(LidarClock, SaysHonestlyHowWellItIsKnownFromTheFirstPacketOn) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    ClockRun run({.drift_ppm = 60.0, .mean_delay_ns = 1'000'000, .rays = 0, .seed = seed});
    run.run(seconds(3));
    EXPECT_LT(run.worst_in_sigmas, 3.0) << "seed " << seed;
  }
}

TEST(LidarClock, FollowsItsDriftOverMinutesAndAcrossTheSwitchOfWindows) {
  ClockRun run({.drift_ppm = 60.0, .rays = 0});
  run.run(seconds(10));
  run.forget_errors();
  run.run(seconds(110));
  EXPECT_LT(run.worst, microseconds(50));
  EXPECT_EQ(run.clock.state().restarts, 0U);
}

ClockRun locked_run(double drift_ppm, unsigned seed) {
  ClockRun run({.drift_ppm = drift_ppm, .steered = true, .rays = 0, .seed = seed});
  run.pps_wired = run.reports = true;
  run.pps = PpsState::kLocked;
  return run;
}

TEST(LidarClock, IsKnownToATenthOfAMillisecondWherePpsIsLocked) {
  nanoseconds worst{0};
  for (unsigned seed = 1; seed <= 8; ++seed) {
    ClockRun run = locked_run(seed % 2 == 0 ? 60.0 : -60.0, seed);
    run.run(seconds(10));
    EXPECT_EQ(run.clock.state().source, LidarClockSource::kPps);
    EXPECT_EQ(run.clock.mapping()->quality, StampQuality::kMeasured);
    run.forget_errors();
    run.run(seconds(12));
    worst = std::max(worst, run.worst);
  }
  RecordProperty("worst_ns", static_cast<int>(worst.count()));
  EXPECT_LT(worst, microseconds(100));
}

TEST(LidarClock, DoesNotBelieveALockThatTheArrivalsContradict) {
  ClockRun run = locked_run(0.0, 1);
  run.run(seconds(5));
  ASSERT_EQ(run.clock.state().source, LidarClockSource::kPps);
  // The sensor goes on saying that it is locked, but its seconds are not the pulses any more.
  run.lidar.set_clock(milliseconds(300), true);
  run.pps_wired = false;
  HostTime pulse = run.lidar.host_time(SensorTime(seconds(706))) + milliseconds(300);
  run.forget_errors();
  for (int i = 0; i < 6; ++i, pulse += seconds(1)) {
    run.clock.add(Edge{EdgeLine::kPps, true, pulse});
    run.run(seconds(1));
  }
  EXPECT_EQ(run.clock.state().source, LidarClockSource::kArrivals);
  EXPECT_GT(run.clock.state().pps_disagreements, 0U);
  EXPECT_LT(run.worst, milliseconds(5));
}

TEST(LidarClock, GoesOnByArrivalsWhenTheLockIsLost) {
  ClockRun run = locked_run(60.0, 1);
  run.run(seconds(10));
  run.pps = PpsState::kAbsent;
  run.run(seconds(1));
  EXPECT_EQ(run.clock.state().source, LidarClockSource::kArrivals);
  EXPECT_EQ(run.clock.mapping()->quality, StampQuality::kEstimated);
}

TEST(LidarClock, GoesOnByArrivalsWhenTheSensorNoLongerReports) {
  ClockRun run = locked_run(0.0, 1);
  run.run(seconds(6));
  run.reports = false;
  run.run(seconds(3));
  EXPECT_EQ(run.clock.state().source, LidarClockSource::kArrivals);
}

TEST(LidarClock, GoesOnByArrivalsWhenTheHostNoLongerSeesThePulses) {
  ClockRun run = locked_run(0.0, 1);
  run.run(seconds(6));
  run.pps_wired = false;
  run.run(seconds(4));
  EXPECT_EQ(run.clock.state().source, LidarClockSource::kArrivals);
  EXPECT_LT(run.worst, milliseconds(5));
}

TEST(LidarClock, KeepsPpsThroughALostAndADoubledPulse) {
  ClockRun run = locked_run(30.0, 3);
  run.run(seconds(10));
  run.forget_errors();
  run.pps_wired = false;
  run.run(milliseconds(1000));
  run.pps_wired = true;
  run.run(seconds(2));
  run.clock.add(Edge{EdgeLine::kPps, true, run.lidar.host_time(run.lidar.now())});
  run.run(seconds(5));
  EXPECT_EQ(run.clock.state().source, LidarClockSource::kPps);
  EXPECT_LT(run.worst, microseconds(100));
}

TEST(LidarClock, BeginsAnewWithANewEpoch) {
  ClockRun run({.rays = 0});
  run.run(seconds(10));
  run.lidar.set_clock(std::chrono::minutes(17), true);
  run.forget_errors();
  run.run(seconds(1));
  EXPECT_LT(run.worst, milliseconds(6));  // from the first packet on
  EXPECT_EQ(run.clock.epoch(), 1U);
  EXPECT_EQ(run.clock.state().restarts, 1U);
}

TEST(LidarClock, NoticesASmallStepThatTheDecoderDidNot) {
  for (const microseconds step : {microseconds(-2000), microseconds(2000)}) {
    ClockRun run({.mean_delay_ns = 300'000, .rays = 0});
    run.run(seconds(15));
    run.lidar.set_clock(step, false);
    run.run(seconds(4));
    run.forget_errors();
    run.run(seconds(4));
    EXPECT_LT(run.worst, microseconds(500)) << step.count();
    EXPECT_GE(run.clock.state().restarts, 1U);
  }
}

TEST(LidarClock, IsNotMisledByOneImpossiblyEarlyArrival) {
  ClockRun run({.rays = 0});
  run.run(seconds(12));
  DecodedPacket early = run.lidar.next();
  early.arrival -= milliseconds(30);
  run.clock.add(early);
  run.forget_errors();
  run.run(seconds(5));
  EXPECT_LT(run.worst, microseconds(100));
  EXPECT_EQ(run.clock.state().restarts, 0U);
}

TEST(LidarClock, SurvivesSecondsWithoutPackets) {
  ClockRun run({.drift_ppm = -60.0, .rays = 0});
  run.run(seconds(12));
  run.lidar.lose(20'000);
  run.forget_errors();
  run.run(seconds(5));
  EXPECT_LT(run.worst, microseconds(200));
}

RC_GTEST_PROP(LidarClock, IsWithinItsUncertaintyForAnySensor, (unsigned seed)) {
  ClockRun run({.offset = seconds(*rc::gen::inRange(-3600, 3600)),
                .drift_ppm = static_cast<double>(*rc::gen::inRange(-100, 101)),
                .mean_delay_ns = static_cast<double>(*rc::gen::inRange(50'000, 1'000'000)),
                .rays = 0,
                .seed = seed});
  const int parts = *rc::gen::inRange(1, 5);
  for (int i = 0; i < parts; ++i) {
    run.run(milliseconds(*rc::gen::inRange(1, 1500)));
    run.lidar.lose(static_cast<std::uint32_t>(*rc::gen::inRange(0, 400)));
  }
  RC_ASSERT(run.worst_in_sigmas < 5.0);
}

}  // namespace
}  // namespace sparsight
