#include "realtime/sync/lidar_buffer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>

#include "tests/realtime/sync/made_lidar.h"

namespace sparsight {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr MadeLidarOptions kExactLidar{.drift_ppm = 0.0, .mean_delay_ns = 1.0, .slow_share = 0.0};

ClockLine exact_line(const MadeLidar& lidar) {
  return {.sensor = MadeLidar::kStart, .host = lidar.host_time(MadeLidar::kStart)};
}

void fill_buffer(LidarBuffer& buffer, MadeLidar& lidar, int packets) {
  for (int i = 0; i < packets; ++i) {
    DecodedPacket packet = lidar.next();
    buffer.add(packet);
  }
}

SweepOutcome newest_sweep(const LidarBuffer& buffer, const MadeLidar& lidar, Sweep& sweep) {
  const HostTime now = lidar.host_time(lidar.now()) + milliseconds(1);
  return buffer.sweep(now, exact_line(lidar), now - milliseconds(15), sweep);
}

// Of one ring, the azimuths that a sweep holds.
std::vector<float> azimuths_of(const Sweep& sweep, const MadeLidar& lidar, std::uint16_t ring) {
  std::vector<float> azimuths;
  const HostTime exposure = lidar.host_time(lidar.now()) + milliseconds(1) - milliseconds(15);
  for (const LidarReturn& r : sweep.returns) {
    if (r.ring != ring) continue;
    const HostTime fired = exposure + nanoseconds(r.from_exposure_ns);
    azimuths.push_back(
        lidar.azimuth_at(MadeLidar::kStart + (fired - lidar.host_time(MadeLidar::kStart))));
  }
  return azimuths;
}

TEST(LidarBuffer, GivesExactlyOneTurnOfTheHead) {
  for (const double rpm : {300.0, 600.0, 613.7, 1200.0}) {
    MadeLidarOptions options = kExactLidar;
    options.rpm = rpm;
    MadeLidar lidar(options);
    LidarBuffer buffer;
    fill_buffer(buffer, lidar, 400);
    Sweep sweep;
    ASSERT_EQ(newest_sweep(buffer, lidar, sweep), SweepOutcome::kWhole);
    const double firings = 60e9 / rpm / 55'296.0;  // of a laser in a turn
    for (std::uint16_t ring = 0; ring < 16; ++ring) {
      const auto azimuths = azimuths_of(sweep, lidar, ring);
      EXPECT_NEAR(static_cast<double>(azimuths.size()), firings, 1.5) << rpm << " rpm";
      double turned = 0.0;
      for (std::size_t i = 1; i < azimuths.size(); ++i) {
        const float step = std::remainder(azimuths[i] - azimuths[i - 1], 360.0F);
        EXPECT_GT(step, 0.0F);
        turned += step;
      }
      EXPECT_LT(turned, 360.0);
      EXPECT_GT(turned, 359.0);
    }
  }
}

TEST(LidarBuffer, GivesReturnsRingByRingInTheOrderOfFiring) {
  MadeLidar lidar(kExactLidar);
  LidarBuffer buffer;
  fill_buffer(buffer, lidar, 200);
  Sweep sweep;
  ASSERT_EQ(newest_sweep(buffer, lidar, sweep), SweepOutcome::kWhole);
  EXPECT_FALSE(sweep.motion_compensated);
  for (std::size_t i = 1; i < sweep.returns.size(); ++i) {
    const LidarReturn& a = sweep.returns[i - 1];
    const LidarReturn& b = sweep.returns[i];
    EXPECT_TRUE(a.ring < b.ring || (a.ring == b.ring && a.from_exposure_ns < b.from_exposure_ns));
  }
}

TEST(LidarBuffer, LeavesOutWhatArrivedLater) {
  MadeLidar lidar(kExactLidar);
  LidarBuffer buffer;
  fill_buffer(buffer, lidar, 200);
  const HostTime ready = lidar.host_time(lidar.now());
  fill_buffer(buffer, lidar, 100);
  Sweep sweep;
  ASSERT_EQ(buffer.sweep(ready, exact_line(lidar), ready, sweep), SweepOutcome::kWhole);
  for (const LidarReturn& r : sweep.returns) EXPECT_LE(r.from_exposure_ns, 0);
  EXPECT_GT(std::max_element(sweep.returns.begin(), sweep.returns.end(),
                             [](const auto& a, const auto& b) {
                               return a.from_exposure_ns < b.from_exposure_ns;
                             })
                ->from_exposure_ns,
            -3'000'000);
}

TEST(LidarBuffer, GivesPartOfATurnWhileNoMoreHasCome) {
  MadeLidar lidar(kExactLidar);
  LidarBuffer buffer;
  Sweep sweep;
  EXPECT_EQ(newest_sweep(buffer, lidar, sweep), SweepOutcome::kNoPackets);
  fill_buffer(buffer, lidar, 30);
  EXPECT_EQ(newest_sweep(buffer, lidar, sweep), SweepOutcome::kPartial);
  EXPECT_EQ(sweep.returns.size(), 30U * 24 * 16);
}

TEST(LidarBuffer, LeavesAGapWherePacketsWereLost) {
  MadeLidar lidar(kExactLidar);
  LidarBuffer buffer;
  fill_buffer(buffer, lidar, 150);
  lidar.lose(10);
  fill_buffer(buffer, lidar, 40);
  Sweep sweep;
  ASSERT_EQ(newest_sweep(buffer, lidar, sweep), SweepOutcome::kWhole);
  EXPECT_NEAR(static_cast<double>(sweep.returns.size()), (75.35 - 10) * 24 * 16, 30.0);
}

TEST(LidarBuffer, DoesNotMixTwoEpochsOfTheClock) {
  MadeLidar lidar(kExactLidar);
  LidarBuffer buffer;
  fill_buffer(buffer, lidar, 150);
  lidar.set_clock(seconds(5), true);
  fill_buffer(buffer, lidar, 20);
  Sweep sweep;
  const HostTime now = lidar.host_time(lidar.now()) + milliseconds(1);
  EXPECT_EQ(buffer.sweep(now, exact_line(lidar), now, sweep), SweepOutcome::kPartial);
  EXPECT_EQ(sweep.returns.size(), 20U * 24 * 16);
}

TEST(LidarBuffer, GivesNothingFarFromTheExposure) {
  MadeLidar lidar(kExactLidar);
  LidarBuffer buffer;
  fill_buffer(buffer, lidar, 150);
  const HostTime later = lidar.host_time(lidar.now()) + milliseconds(400);
  Sweep sweep;
  EXPECT_EQ(buffer.sweep(later, exact_line(lidar), later, sweep), SweepOutcome::kTooOld);
  EXPECT_TRUE(sweep.returns.empty());
}

TEST(LidarBuffer, GivesWhatThereIsOfAHeadThatStands) {
  MadeLidarOptions options = kExactLidar;
  options.rpm = 0.0;
  MadeLidar lidar(options);
  LidarBuffer buffer;
  fill_buffer(buffer, lidar, 400);
  Sweep sweep;
  newest_sweep(buffer, lidar, sweep);
  EXPECT_LE(sweep.returns.size(), 190U * 24 * 16);  // a quarter of a second
}

RC_GTEST_PROP(LidarBuffer, NeverGivesAReturnTwiceNorMoreThanATurn, (unsigned seed)) {
  MadeLidarOptions options = kExactLidar;
  options.rpm = *rc::gen::inRange(280, 1300);
  options.rays = 2;
  options.seed = seed;
  MadeLidar lidar(options);
  LidarBuffer buffer;
  const int parts = *rc::gen::inRange(1, 5);
  for (int i = 0; i < parts; ++i) {
    fill_buffer(buffer, lidar, *rc::gen::inRange(1, 120));
    lidar.lose(static_cast<std::uint32_t>(*rc::gen::inRange(0, 20)));
  }
  fill_buffer(buffer, lidar, *rc::gen::inRange(1, 50));
  Sweep sweep;
  const SweepOutcome outcome = newest_sweep(buffer, lidar, sweep);
  RC_ASSERT(outcome == SweepOutcome::kWhole || outcome == SweepOutcome::kPartial);
  std::set<std::pair<int, std::int32_t>> seen;
  for (const LidarReturn& r : sweep.returns) {
    RC_ASSERT(seen.emplace(r.ring, r.from_exposure_ns).second);
  }
  const auto [first, last] = std::minmax_element(
      sweep.returns.begin(), sweep.returns.end(),
      [](const auto& a, const auto& b) { return a.from_exposure_ns < b.from_exposure_ns; });
  RC_ASSERT(static_cast<double>(last->from_exposure_ns - first->from_exposure_ns) <
            60e9 / options.rpm + 1.0);
}

}  // namespace
}  // namespace sparsight
