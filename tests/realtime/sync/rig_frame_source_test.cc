#include "realtime/sync/rig_frame_source.h"

#include <gtest/gtest.h>

#include "tests/realtime/sync/made_rig.h"

namespace sparsight {
namespace {

TEST(RigFrameSource, YieldsWhatTheEventsHold) {
  MadeRig rig({}, {.rays = 1});
  rig.camera.shoot_many(40);
  rig.camera.shoot_many(2, {.lose_frame = true});
  rig.camera.shoot_many(20, {.lose_rise = true, .lose_fall = true});
  rig.run_lidar(std::chrono::seconds(3));
  RigFrameSource source(std::make_unique<MadeEventSource>(rig.events()), rig.decoder(),
                        MadeRig::calibration(), sync_config({}));
  EXPECT_EQ(source.calibration().camera.width, 4);
  EXPECT_FALSE(source.frame_count());
  std::uint64_t count = 0;
  HostTime last{};
  while (const auto frame = source.next()) {
    EXPECT_EQ(frame->sequence, count++);
    EXPECT_GT(frame->exposure, last);
    last = frame->exposure;
    EXPECT_EQ(frame->grey.width, 4);
    EXPECT_FALSE(frame->sweep.motion_compensated);
  }
  EXPECT_EQ(count, 52U);
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.sync_state().camera.frames_lost, 2U);
  EXPECT_EQ(source.sync_state().camera.frames_estimated, 20U);
}

TEST(RigFrameSource, EndsWithoutEvents) {
  MadeRig rig;
  RigFrameSource source(std::make_unique<MadeEventSource>(std::vector<RigEvent>{}), rig.decoder(),
                        MadeRig::calibration(), sync_config({}), {}, 0);
  EXPECT_EQ(source.frame_count(), 0U);
  EXPECT_FALSE(source.next());
}

}  // namespace
}  // namespace sparsight
