#include "realtime/sync/synchronizer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "tests/realtime/sync/made_rig.h"

namespace sparsight {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr MadeLidarOptions kSparseLidar{.drift_ppm = 60.0, .rays = 1};

struct SyncRun {
  std::vector<BundledFrame> frames;
  SyncState state;
};

SyncRun synchronize(const MadeRig& rig, const SyncConfig& config = sync_config({})) {
  Synchronizer synchronizer(MadeRig::calibration(), config, rig.decoder());
  SyncRun run;
  for (const RigEvent& event : rig.events()) {
    synchronizer.add(event);
    while (auto frame = synchronizer.take()) run.frames.push_back(std::move(*frame));
  }
  synchronizer.finish();
  while (auto frame = synchronizer.take()) run.frames.push_back(std::move(*frame));
  run.state = synchronizer.state();
  return run;
}

// The worst error of a firing's time, its exposure's own error left out.
nanoseconds worst_firing(const MadeRig& rig, const std::vector<BundledFrame>& frames,
                         std::size_t from) {
  nanoseconds worst{0};
  for (std::size_t i = from; i < frames.size(); ++i) {
    for (const LidarReturn& r : frames[i].frame.sweep.returns) {
      const HostTime mapped = frames[i].frame.exposure + nanoseconds(r.from_exposure_ns);
      const HostTime truth = rig.lidar.host_time(MadeLidar::read(r.p_lidar));
      worst = std::max(worst, std::chrono::abs(mapped - truth));
    }
  }
  return worst;
}

TEST(Synchronizer, PutsFramesAndReturnsOnOneClock) {
  MadeRig rig({}, kSparseLidar);
  rig.camera.shoot_many(400);
  rig.run_lidar(seconds(14));
  const SyncRun run = synchronize(rig);
  ASSERT_EQ(run.frames.size(), 392U);  // all but those that made the association
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const BundledFrame& f = run.frames[i];
    EXPECT_EQ(f.frame.sequence, i);
    EXPECT_EQ(f.stamp.quality, StampQuality::kMeasured);
    EXPECT_EQ(f.frame.exposure, f.stamp.mapped);
    EXPECT_EQ(f.camera_sequence, i + 8);
    EXPECT_EQ(f.frame.grey.pixels, std::vector<std::uint8_t>(8, static_cast<std::uint8_t>(i + 8)));
    EXPECT_TRUE(f.frame.faults.empty());
    if (i > 0) {
      EXPECT_GT(f.frame.exposure, run.frames[i - 1].frame.exposure);
    }
    EXPECT_NEAR(static_cast<double>(f.frame.sweep.returns.size()), 1808.5, 2.0);
  }
  EXPECT_LT(worst_firing(rig, run.frames, 292), microseconds(500));
  EXPECT_EQ(run.state.frames_out, 392U);
  EXPECT_EQ(run.state.frames_without_returns, 0U);
  EXPECT_EQ(run.state.lidar.source, LidarClockSource::kArrivals);
  EXPECT_TRUE(run.state.camera.locked);
}

TEST(Synchronizer, PutsThemThereBetterWithPps) {
  MadeRig rig({}, {.drift_ppm = 60.0, .steered = true, .rays = 1});
  rig.camera.shoot_many(400);
  rig.run_lidar(seconds(14), true);
  const SyncRun run = synchronize(rig);
  EXPECT_EQ(run.state.lidar.source, LidarClockSource::kPps);
  EXPECT_LT(worst_firing(rig, run.frames, 292), microseconds(100));
}

TEST(Synchronizer, TakesReturnsFromBeforeTheExposureToShortlyAfter) {
  MadeRig rig({}, kSparseLidar);
  rig.camera.shoot_many(60);
  rig.run_lidar(seconds(3));
  const SyncRun run = synchronize(rig);
  for (const BundledFrame& f : run.frames) {
    const auto [first, last] = std::minmax_element(
        f.frame.sweep.returns.begin(), f.frame.sweep.returns.end(),
        [](const auto& a, const auto& b) { return a.from_exposure_ns < b.from_exposure_ns; });
    // The frame is there some 15 ms after its exposure.
    EXPECT_NEAR(last->from_exposure_ns, 13'000'000, 8'000'000);
    EXPECT_NEAR(last->from_exposure_ns - first->from_exposure_ns, 100'000'000, 200'000);
  }
}

TEST(Synchronizer, GivesTheSameFramesForTheSameEvents) {
  MadeRig rig({}, kSparseLidar);
  rig.camera.shoot_many(40);
  rig.camera.shoot_many(3, {.late = milliseconds(50)});
  rig.camera.shoot_many(40, {.lose_fall = true});
  rig.run_lidar(seconds(3));
  const SyncRun a = synchronize(rig);
  const SyncRun b = synchronize(rig);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].frame.exposure, b.frames[i].frame.exposure);
    ASSERT_EQ(a.frames[i].frame.sweep.returns.size(), b.frames[i].frame.sweep.returns.size());
    for (std::size_t k = 0; k < a.frames[i].frame.sweep.returns.size(); ++k) {
      EXPECT_EQ(a.frames[i].frame.sweep.returns[k].from_exposure_ns,
                b.frames[i].frame.sweep.returns[k].from_exposure_ns);
    }
  }
}

TEST(Synchronizer, GivesFramesWithoutReturnsAndSaysSoWhenTheLidarIsAway) {
  MadeRig rig({}, kSparseLidar);
  rig.camera.shoot_many(120);
  rig.run_lidar(seconds(1));
  rig.lidar.lose(1130);  // a second and a half
  rig.run_lidar(seconds(2));
  const SyncRun run = synchronize(rig);
  EXPECT_EQ(run.frames.size(), 112U);
  EXPECT_NEAR(static_cast<double>(run.state.frames_without_returns), (1500.0 - 265) / 33.3, 3.0);
  for (const BundledFrame& f : run.frames) {
    EXPECT_EQ(f.frame.sweep.returns.empty(), !f.frame.faults.empty());
    EXPECT_FALSE(f.frame.grey.empty());
  }
}

TEST(Synchronizer, GivesFramesOfACameraAlone) {
  MadeRig rig;
  rig.camera.shoot_many(20);
  const SyncRun run = synchronize(rig);
  ASSERT_EQ(run.frames.size(), 12U);
  ASSERT_EQ(run.frames[0].frame.faults.size(), 1U);
  EXPECT_EQ(run.frames[0].frame.faults[0].message, "nothing has come from the LiDAR yet");
}

TEST(Synchronizer, KeepsThePlaceOfADamagedFrame) {
  MadeRig rig({}, kSparseLidar);
  rig.camera.shoot_many(20);
  rig.camera.set_damaged(true);
  rig.camera.shoot();
  rig.camera.set_damaged(false);
  rig.camera.shoot_many(5);
  rig.run_lidar(seconds(2));
  const SyncRun run = synchronize(rig);
  ASSERT_EQ(run.frames.size(), 18U);
  EXPECT_TRUE(run.frames[12].frame.grey.empty());
  ASSERT_EQ(run.frames[12].frame.faults.size(), 1U);
  EXPECT_NE(run.frames[12].frame.faults[0].message.find("frame 20 was damaged"), std::string::npos);
  EXPECT_FALSE(run.frames[12].frame.sweep.returns.empty());
}

TEST(Synchronizer, RefusesImagesOfAnotherSizeThanTheCalibration) {
  MadeRig rig;
  rig.camera.shoot_many(20);
  RigCalibration calibration = MadeRig::calibration();
  calibration.camera.width = 800;
  Synchronizer synchronizer(calibration, sync_config({}), rig.decoder());
  for (const RigEvent& event : rig.events()) synchronizer.add(event);
  const auto frame = synchronizer.take();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->frame.grey.empty());
  EXPECT_EQ(frame->frame.faults[0].code, ErrorCode::kWrongSize);
}

TEST(Synchronizer, DropsTheOldestOfFramesThatNobodyTakes) {
  MadeRig rig;
  rig.camera.shoot_many(48);
  Synchronizer synchronizer(MadeRig::calibration(), sync_config({}), rig.decoder());
  for (const RigEvent& event : rig.events()) synchronizer.add(event);
  EXPECT_EQ(synchronizer.state().frames_not_taken, 24U);
  const auto frame = synchronizer.take();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->camera_sequence, 32U);
}

TEST(Synchronizer, LeavesFramesOutWhoseExposureIsNotKnown) {
  MadeRig rig;
  rig.camera.shoot_many(50, {.lose_rise = true, .lose_fall = true});
  const SyncRun run = synchronize(rig);
  EXPECT_TRUE(run.frames.empty());
  EXPECT_EQ(run.state.camera.frames_unsynchronized, 50U);
}

TEST(Synchronizer, TakesTheDriversTimeWhereTheSettingsSaySo) {
  MadeRig rig;
  rig.camera.shoot_many(50, {.lose_rise = true, .lose_fall = true});
  SyncConfig config = sync_config({});
  config.exposure_source = ExposureSource::kDriverTime;
  const SyncRun run = synchronize(rig, config);
  ASSERT_EQ(run.frames.size(), 50U);
  EXPECT_EQ(run.frames[3].stamp.quality, StampQuality::kEstimated);
}

TEST(Synchronizer, DoesNotWaitForACameraThatIsGone) {
  MadeRig rig;
  rig.camera.shoot_many(5);
  Synchronizer synchronizer(MadeRig::calibration(), sync_config({}), rig.decoder());
  for (const RigEvent& event : rig.events()) synchronizer.add(event);
  EXPECT_EQ(synchronizer.state().camera.frames_unsynchronized, 0U);
  synchronizer.add(DeviceStateChange{DeviceKind::kCamera, DeviceState::kGone, rig.camera.now()});
  EXPECT_EQ(synchronizer.state().camera.frames_unsynchronized, 5U);
}

TEST(Synchronizer, CountsPacketsThatAreNone) {
  MadeRig rig;
  Synchronizer synchronizer(MadeRig::calibration(), sync_config({}), rig.decoder());
  LidarPacket packet;
  packet.payload.fill(0xFF);
  synchronizer.add(packet);
  synchronizer.add(std::shared_ptr<const CameraFrame>());
  EXPECT_EQ(synchronizer.state().packets.refused, 1U);
}

// Recordings can hold anything. Under the sanitizers this is where arithmetic would overflow.
RC_GTEST_PROP(Synchronizer, TakesAnyTimesAndCounts, ()) {
  MadeRig rig({}, kSparseLidar);
  rig.camera.shoot_many(30);
  rig.run_lidar(milliseconds(150));
  Synchronizer synchronizer(MadeRig::calibration(), sync_config({}), rig.decoder());
  const auto any_time = [] { return HostTime(nanoseconds(*rc::gen::arbitrary<std::int64_t>())); };
  for (const RigEvent& event : rig.events()) {
    if (*rc::gen::inRange(0, 10) == 0) {
      auto frame = std::make_shared<CameraFrame>();
      frame->sequence = *rc::gen::arbitrary<std::uint32_t>();
      frame->epoch = *rc::gen::inRange<std::uint32_t>(0, 3);
      frame->driver_time = any_time();
      frame->arrival = *rc::gen::arbitrary<bool>() ? any_time() : arrival_of(event);
      frame->exposure = nanoseconds(*rc::gen::arbitrary<std::int64_t>());
      synchronizer.add(std::shared_ptr<const CameraFrame>(std::move(frame)));
      synchronizer.add(Edge{EdgeLine::kPps, *rc::gen::arbitrary<bool>(), any_time()});
      synchronizer.add(Edge{EdgeLine::kExposure, *rc::gen::arbitrary<bool>(), any_time()});
      LidarPacket packet{.arrival = any_time()};
      synchronizer.add(packet);
    }
    synchronizer.add(event);
    while (const auto frame = synchronizer.take()) RC_ASSERT(frame->frame.exposure >= HostTime{});
  }
}

}  // namespace
}  // namespace sparsight
