#include "drivers/v4l2/v4l2_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/drivers/v4l2/fake_video.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Trouble = testing::FakeVideo::Trouble;

class V4l2CameraTest : public ::testing::Test {
 protected:
  CameraFrame next(std::chrono::nanoseconds patience = 1s) {
    auto frame = camera_.read(patience);
    EXPECT_TRUE(frame) << camera_.last_fault();
    return frame ? std::move(*frame) : CameraFrame{};
  }
  std::vector<std::uint32_t> sequences(int count) {
    std::vector<std::uint32_t> read;
    for (int i = 0; i < count; ++i) read.push_back(next().sequence);
    return read;
  }

  testing::FakeVideo video_;
  V4l2Camera camera_{{.device = "/dev/v4l/by-id/eye"}, video_};
};

TEST_F(V4l2CameraTest, DeliversFramesWithTheDriversStampAndItsOwnArrival) {
  ASSERT_TRUE(camera_.start());
  EXPECT_EQ(camera_.state(), DeviceState::kStreaming);
  const HostTime started = video_.clock;
  const CameraFrame frame = next();
  EXPECT_EQ(frame.sequence, 0U);
  EXPECT_EQ(frame.width, 800);
  EXPECT_EQ(frame.height, 600);
  EXPECT_EQ(frame.stride_bytes, 800);
  EXPECT_EQ(frame.format, PixelFormat::kGrey8);
  EXPECT_EQ(frame.bytes, std::vector<std::uint8_t>(480000, 1));
  EXPECT_FALSE(frame.damaged);
  EXPECT_EQ(frame.arrival, video_.clock);
  EXPECT_NEAR(to_seconds(frame.arrival - started), 1.0 / 30.0, 1e-6);
  EXPECT_NEAR(to_seconds(frame.arrival - frame.driver_time), 0.005, 1e-6);
  EXPECT_THAT(sequences(3), ElementsAre(1, 2, 3));
  EXPECT_EQ(camera_.counters().frames, 4U);
  EXPECT_EQ(camera_.counters().lost, 0U);
}

TEST_F(V4l2CameraTest, AStampOnAnotherClockIsReplacedByTheArrival) {
  video_.timestamp_flags = V4L2_BUF_FLAG_TIMESTAMP_UNKNOWN;
  ASSERT_TRUE(camera_.start());
  const CameraFrame frame = next();
  EXPECT_EQ(frame.driver_time, frame.arrival);
}

TEST_F(V4l2CameraTest, AStampFromTheFutureIsReplacedByTheArrival) {
  video_.transfer = -1s;
  ASSERT_TRUE(camera_.start());
  const CameraFrame frame = next();
  EXPECT_EQ(frame.driver_time, frame.arrival);
}

TEST_F(V4l2CameraTest, FramesThatTheDriverLostAreCounted) {
  video_.troubles[1].lost = true;
  video_.troubles[2].lost = true;
  ASSERT_TRUE(camera_.start());
  EXPECT_THAT(sequences(2), ElementsAre(0, 3));
  EXPECT_EQ(camera_.counters().lost, 2U);
}

TEST_F(V4l2CameraTest, DamagedFramesAreMarkedAndTheirBuffersGoOn) {
  for (int i = 0; i < 20; ++i) video_.troubles[i].error_flag = true;
  video_.troubles[3] = Trouble{.missing_bytes = 100};
  ASSERT_TRUE(camera_.start());
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(next().damaged);
  EXPECT_FALSE(next().damaged);
  EXPECT_EQ(camera_.counters().damaged, 20U);
  EXPECT_EQ(camera_.counters().lost, 0U);
}

TEST_F(V4l2CameraTest, AShortFrameKeepsItsSize) {
  video_.troubles[0].missing_bytes = 480000 - 2;
  ASSERT_TRUE(camera_.start());
  const CameraFrame frame = next();
  EXPECT_TRUE(frame.damaged);
  ASSERT_EQ(frame.bytes.size(), 480000U);
  EXPECT_EQ(frame.bytes[1], 1);
  EXPECT_EQ(frame.bytes[2], 0);
}

TEST_F(V4l2CameraTest, AConsumerThatComesLateLosesNothingThatTheDriverHeld) {
  ASSERT_TRUE(camera_.start());
  for (int pause = 0; pause < 8; ++pause) {
    video_.pass(150ms);  // four or five of six buffers
    next();
  }
  EXPECT_EQ(video_.queued(), 6U);
  for (int i = 0; i < 20; ++i) next(0ns);
  EXPECT_EQ(camera_.counters().lost, 0U);
}

TEST_F(V4l2CameraTest, WhatWaitsTooLongIsLostFromTheFrontAndCounted) {
  ASSERT_TRUE(camera_.start());
  for (int pause = 0; pause < 60; ++pause) {
    video_.pass(150ms);
    next();
  }
  const CameraCounters counters = camera_.counters();
  EXPECT_GT(counters.lost, 0U);
  EXPECT_EQ(video_.queued(), 6U) << "the driver has all its buffers";
}

TEST_F(V4l2CameraTest, RecycledMemoryServesAgain) {
  ASSERT_TRUE(camera_.start());
  CameraFrame frame = next();
  const std::uint8_t* memory = frame.bytes.data();
  camera_.recycle(std::move(frame.bytes));
  EXPECT_EQ(next().bytes.data(), memory);
}

TEST_F(V4l2CameraTest, NoTriggerIsSilenceNotAnError) {
  video_.triggered = false;
  ASSERT_TRUE(camera_.start());
  EXPECT_FALSE(camera_.read(100ms));
  EXPECT_EQ(camera_.state(), DeviceState::kStreaming) << "three periods are no silence";
  EXPECT_FALSE(camera_.read(100ms));
  EXPECT_EQ(camera_.state(), DeviceState::kSilent);
  video_.triggered = true;
  next();
  EXPECT_EQ(camera_.state(), DeviceState::kStreaming);
  EXPECT_EQ(camera_.counters().restarts, 0U);
}

TEST_F(V4l2CameraTest, AnUnpluggedCameraIsLookedForUnderItsPathAndComesBackAsANewEpoch) {
  video_.troubles[2].unplugged = true;
  ASSERT_TRUE(camera_.start());
  EXPECT_THAT(sequences(2), ElementsAre(0, 1));
  EXPECT_FALSE(camera_.read(1s));
  EXPECT_EQ(camera_.state(), DeviceState::kGone);
  EXPECT_EQ(video_.open_fds, 0);
  EXPECT_EQ(video_.mapped, 0);
  EXPECT_GE(video_.opened.size(), 4U) << "it goes on looking";
  EXPECT_THAT(camera_.last_fault(), HasSubstr("is the camera plugged in?"));
  video_.plugged = true;
  const CameraFrame frame = next();
  EXPECT_EQ(frame.sequence, 0U);
  EXPECT_EQ(frame.epoch, 1U);
  EXPECT_EQ(camera_.state(), DeviceState::kStreaming);
  EXPECT_EQ(camera_.counters().restarts, 1U);
  EXPECT_EQ(camera_.counters().lost, 0U) << "sequences of two epochs do not compare";
  EXPECT_EQ(video_.opened.back(), "/dev/v4l/by-id/eye");
}

TEST_F(V4l2CameraTest, AnInputErrorRestartsTheStreamWithinTheSameRead) {
  video_.troubles[1].dequeue_errno = EIO;
  ASSERT_TRUE(camera_.start());
  next();
  const CameraFrame frame = next(100ms);
  EXPECT_EQ(frame.epoch, 1U);
  EXPECT_EQ(camera_.counters().restarts, 1U);
  EXPECT_THAT(camera_.last_fault(), HasSubstr("cannot take a frame"));
  EXPECT_EQ(video_.open_fds, 1);
  EXPECT_EQ(video_.mapped, 6);
}

TEST_F(V4l2CameraTest, AStreamThatFailsAtOnceIsNotRestartedInALoop) {
  for (int i = 0; i < 1000; ++i) video_.troubles[i].dequeue_errno = EIO;
  ASSERT_TRUE(camera_.start());
  EXPECT_FALSE(camera_.read(2s));
  EXPECT_LE(camera_.counters().restarts, 11U);
  EXPECT_GE(camera_.counters().restarts, 5U);
}

TEST_F(V4l2CameraTest, AChangedSourceIsNegotiatedAnew) {
  video_.troubles[1].source_changes = true;
  ASSERT_TRUE(camera_.start());
  EXPECT_EQ(next().epoch, 0U);
  video_.formats = {{V4L2_PIX_FMT_YUYV, 800, 600, 1600, 960000}};
  const CameraFrame frame = next();
  EXPECT_EQ(frame.epoch, 1U);
  EXPECT_EQ(frame.format, PixelFormat::kYuyv);
  EXPECT_EQ(frame.bytes.size(), 960000U);
}

TEST_F(V4l2CameraTest, ASourceThatNoLongerFitsIsWaitedFor) {
  video_.troubles[1].source_changes = true;
  ASSERT_TRUE(camera_.start());
  next();
  const auto formats =
      std::exchange(video_.formats, {{V4L2_PIX_FMT_GREY, 1920, 1080, 1920, 1920 * 1080}});
  EXPECT_FALSE(camera_.read(1s));
  EXPECT_EQ(camera_.state(), DeviceState::kGone);
  EXPECT_THAT(camera_.last_fault(), HasSubstr("GREY comes at 1920x1080"));
  video_.formats = formats;
  EXPECT_EQ(next().epoch, 1U);
}

TEST_F(V4l2CameraTest, ASequenceThatStartsAgainIsANewEpoch) {
  video_.troubles[3].counts_from_zero = true;
  ASSERT_TRUE(camera_.start());
  EXPECT_THAT(sequences(3), ElementsAre(0, 1, 2));
  const CameraFrame frame = next();
  EXPECT_EQ(frame.sequence, 0U);
  EXPECT_EQ(frame.epoch, 1U);
  EXPECT_EQ(camera_.counters().lost, 0U);
}

TEST_F(V4l2CameraTest, ABufferThatCannotBeGivenBackEndsTheStreamButNotTheFrame) {
  ASSERT_TRUE(camera_.start());
  video_.accepts_requeue = false;
  EXPECT_EQ(next().sequence, 0U);
  video_.accepts_requeue = true;
  EXPECT_EQ(next().epoch, 1U);
}

TEST_F(V4l2CameraTest, GivesEverythingBackWhenItStops) {
  ASSERT_TRUE(camera_.start());
  next();
  camera_.stop();
  EXPECT_EQ(video_.open_fds, 0);
  EXPECT_EQ(video_.mapped, 0);
}

TEST_F(V4l2CameraTest, AStartThatFailsLeavesNothingOpen) {
  video_.most_buffers = 1;
  const auto started = camera_.start();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message, HasSubstr("has memory for 1 buffers only"));
  EXPECT_EQ(camera_.state(), DeviceState::kStopped);
  EXPECT_EQ(video_.open_fds, 0);
  EXPECT_EQ(video_.mapped, 0);
  video_.most_buffers = 32;
  EXPECT_TRUE(camera_.start());
}

TEST_F(V4l2CameraTest, ANodeThatDoesNotStreamIsNamed) {
  video_.capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  const auto started = camera_.start();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message, HasSubstr("/dev/v4l/by-id/eye: does not stream"));
}

TEST_F(V4l2CameraTest, AnAbsentCameraSaysWhereToLook) {
  video_.plugged = false;
  const auto started = camera_.start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(started.error().message, HasSubstr("ls /dev/v4l/by-id"));
}

// A link to what stands for the camera, as /dev/v4l/by-path has them.
TEST(V4l2CameraSystemFolder, IsThatOfTheNodeBehindTheLink) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(::testing::TempDir()) / "v4l2_camera_system_folder";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "video3") << "";
  fs::create_symlink("video3", folder / "by-path");
  testing::FakeVideo video;
  EXPECT_EQ(V4l2Camera({.device = folder / "by-path"}, video).system_folder(),
            "/sys/class/video4linux/video3");
  EXPECT_EQ(V4l2Camera({.device = folder / "missing"}, video).system_folder(), "");
}

}  // namespace
}  // namespace sparsight
