#include "drivers/v4l2/camera_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/v4l2/fake_video.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class CameraSettingsTest : public ::testing::Test {
 protected:
  Result<std::chrono::nanoseconds> apply() {
    auto device = VideoDevice::open(video_, "/dev/video0");
    return apply_settings(*device, config_);
  }
  std::string refusal() {
    const auto applied = apply();
    return applied ? "none" : applied.error().message;
  }

  testing::FakeVideo video_;
  CameraConfig config_;
};

class UvcSettingsTest : public CameraSettingsTest {
 protected:
  UvcSettingsTest() {
    video_.controls = {{V4L2_CID_EXPOSURE_AUTO, {"Auto Exposure", V4L2_EXPOSURE_APERTURE_PRIORITY}},
                       {V4L2_CID_EXPOSURE_AUTO_PRIORITY, {"Exposure, Dynamic Framerate", 1, 0, 1}},
                       {V4L2_CID_EXPOSURE_ABSOLUTE, {"Exposure Time, Absolute", 156, 1, 5000}},
                       {V4L2_CID_AUTOGAIN, {"Gain, Automatic", 1, 0, 1}},
                       {V4L2_CID_GAIN, {"Gain", 0, 0, 100}},
                       {0x009a2000, {"Trigger Mode", 0, 0, 3}}};
  }
};

TEST_F(UvcSettingsTest, ManualExposureSwitchesBothAutomaticsOffFirst) {
  config_.exposure = 4000us;
  EXPECT_EQ(apply(), 4ms);
  EXPECT_THAT(video_.set_controls, ElementsAre(Pair(V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL),
                                               Pair(V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0),
                                               Pair(V4L2_CID_EXPOSURE_ABSOLUTE, 40)));
}

TEST_F(UvcSettingsTest, AutomaticExposureIsLeftAloneAndItsTimeUnknown) {
  EXPECT_EQ(apply(), 0ns);
  EXPECT_TRUE(video_.set_controls.empty());
}

TEST_F(UvcSettingsTest, ManualExposureThatIsInForceAlreadyIsRead) {
  video_.controls.at(V4L2_CID_EXPOSURE_AUTO).value = V4L2_EXPOSURE_MANUAL;
  EXPECT_EQ(apply(), 15600us);
}

TEST_F(UvcSettingsTest, GainSwitchesItsAutomaticOff) {
  config_.gain = 64;
  ASSERT_TRUE(apply());
  EXPECT_THAT(video_.set_controls,
              ElementsAre(Pair(V4L2_CID_AUTOGAIN, 0), Pair(V4L2_CID_GAIN, 64)));
}

TEST_F(UvcSettingsTest, ListedControlsAreFoundByEitherNameOrByNumberAndSetInOrder) {
  config_.controls = {{"trigger_mode", 1}, {"Trigger Mode", 2}, {"0x009a2000", 3}};
  ASSERT_TRUE(apply());
  EXPECT_THAT(video_.set_controls,
              ElementsAre(Pair(0x009a2000, 1), Pair(0x009a2000, 2), Pair(0x009a2000, 3)));
}

TEST_F(UvcSettingsTest, AnUnknownControlNamesThoseThereAre) {
  config_.controls = {{"Trigger", 1}};
  EXPECT_THAT(refusal(), HasSubstr("has no control \"Trigger\" of [[camera.controls]]; it has "
                                   "\"Gain, Automatic\", \"Gain\", \"Auto Exposure\""));
}

TEST_F(UvcSettingsTest, AValueOutOfTheCamerasRangeNamesTheRange) {
  config_.gain = 101;
  EXPECT_EQ(refusal(),
            "/dev/video0: control \"Gain\" = 101: must be between 0 and 100, in steps of 1");
}

TEST_F(UvcSettingsTest, AValueThatTheCameraDoesNotKeepIsAnError) {
  video_.controls.at(V4L2_CID_GAIN).step = 8;
  config_.gain = 12;
  EXPECT_EQ(refusal(), "/dev/video0: control \"Gain\" = 12: the camera keeps 8; its steps are 8");
}

TEST_F(UvcSettingsTest, AnExposureAsLongAsThePeriodIsRefused) {
  video_.controls.at(V4L2_CID_EXPOSURE_AUTO).value = V4L2_EXPOSURE_MANUAL;
  video_.controls.at(V4L2_CID_EXPOSURE_ABSOLUTE).value = 317;
  EXPECT_THAT(refusal(), HasSubstr("exposes for 31700 us, which is not below 0.95"));
  video_.controls.at(V4L2_CID_EXPOSURE_ABSOLUTE).value = 316;
  EXPECT_EQ(apply(), 31600us);
}

TEST_F(CameraSettingsTest, ExposureInSensorLinesIsConverted) {
  // 800 + 200 pixels at 50 MHz: 20 us a line.
  video_.controls = {
      {V4L2_CID_EXPOSURE, {"Exposure", 1, 1, 2000}},
      {V4L2_CID_HBLANK, {"Horizontal Blanking", 200}},
      {V4L2_CID_PIXEL_RATE, {"Pixel Rate", 50'000'000, 0, 1LL << 40, V4L2_CTRL_TYPE_INTEGER64}},
      {V4L2_CID_ANALOGUE_GAIN, {"Analogue Gain", 0, 0, 100}}};
  config_.exposure = 5000us;
  config_.gain = 7;
  EXPECT_EQ(apply(), 5ms);
  EXPECT_THAT(video_.set_controls,
              ElementsAre(Pair(V4L2_CID_EXPOSURE, 250), Pair(V4L2_CID_ANALOGUE_GAIN, 7)));
}

TEST_F(CameraSettingsTest, ACameraWithoutTheControlsSaysSo) {
  config_.exposure = 5000us;
  EXPECT_THAT(refusal(), HasSubstr("has no exposure control in known units"));
  config_.exposure.reset();
  config_.gain = 1;
  EXPECT_THAT(refusal(), HasSubstr("has no gain control"));
}

TEST_F(CameraSettingsTest, AListOfBitsKeepsItsHighestBit) {
  video_.controls = {{0x009a3000, {"Lines", 0, 0, 0, V4L2_CTRL_TYPE_BITMASK}}};
  config_.controls = {{"Lines", 0x80000001}};
  EXPECT_EQ(refusal(), "none");
}

}  // namespace
}  // namespace sparsight
