#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/v4l2/v4l2_camera.h"
#include "tests/drivers/gpio/fake_gpio.h"
#include "tests/drivers/v4l2/fake_video.h"
#include "tools/doctor/camera_checks.h"
#include "tools/doctor/lidar_checks.h"
#include "tools/doctor/trigger_checks.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

const Check& check_named(const std::vector<Check>& checks, std::string_view name) {
  static const Check kNone{"none", Verdict::kFail, "", ""};
  for (const Check& check : checks) {
    if (check.name == name) return check;
  }
  ADD_FAILURE() << "no check is named " << name;
  return kNone;
}

class CameraChecks : public ::testing::Test {
 protected:
  CameraChecks() {
    video_.controls = {{V4L2_CID_EXPOSURE_AUTO, {"Auto Exposure", V4L2_EXPOSURE_MANUAL}},
                       {V4L2_CID_EXPOSURE_ABSOLUTE, {"Exposure Time, Absolute", 40}}};
  }
  std::vector<Check> checks() {
    V4l2Camera camera(config_, video_);
    return camera_checks(observe_camera(camera, 3s, [this] { return video_.clock; }), config_);
  }
  testing::FakeVideo video_;
  CameraConfig config_;
};

TEST_F(CameraChecks, AGoodCameraIsGood) {
  const auto all = checks();
  for (const Check& check : all) EXPECT_EQ(check.verdict, Verdict::kOk) << check.name << check.fix;
  EXPECT_EQ(check_named(all, "camera").found, "/dev/video0: GREY 800x600");
  EXPECT_EQ(check_named(all, "camera rate").found, "30.00 Hz of 30");
  EXPECT_EQ(check_named(all, "exposure").found, "4000 us, 12 % of the period");
}

TEST_F(CameraChecks, AnAbsentCameraSaysWhyAndNothingElse) {
  video_.plugged = false;
  const auto all = checks();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].verdict, Verdict::kFail);
  EXPECT_THAT(all[0].fix, HasSubstr("ls /dev/v4l/by-id"));
}

TEST_F(CameraChecks, ACameraWithoutTriggersIsToldFromAnAbsentOne) {
  video_.triggered = false;
  const auto all = checks();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all[0].found, HasSubstr("no frame came"));
}

TEST_F(CameraChecks, ARateThatIsNotTheConfiguredOneIsSeen) {
  video_.keeps_rate = false;  // triggered at 30 Hz
  config_.rate_hz = 20.0;
  EXPECT_EQ(check_named(checks(), "camera rate").verdict, Verdict::kFail);
  config_.rate_hz = 29.0;
  EXPECT_EQ(check_named(checks(), "camera rate").verdict, Verdict::kWarn);
}

TEST_F(CameraChecks, LossesAreWeighed) {
  video_.troubles[10].lost = true;
  EXPECT_EQ(check_named(checks(), "camera losses").verdict, Verdict::kWarn);
  for (int i = 100; i < 110; ++i) video_.troubles[i].error_flag = true;
  EXPECT_EQ(check_named(checks(), "camera losses").verdict, Verdict::kFail);
}

TEST_F(CameraChecks, ALongOrUnknownExposureIsWarnedOf) {
  video_.controls.at(V4L2_CID_EXPOSURE_ABSOLUTE).value = 150;
  EXPECT_EQ(check_named(checks(), "exposure").verdict, Verdict::kWarn);
  video_.controls.clear();
  video_.controls[V4L2_CID_EXPOSURE_AUTO] = {"Auto Exposure", V4L2_EXPOSURE_APERTURE_PRIORITY};
  EXPECT_THAT(check_named(checks(), "exposure").found, HasSubstr("automatic"));
}

class TriggerChecks : public ::testing::Test {
 protected:
  std::vector<Check> checks() {
    GpioTriggerLine line(rig_.trigger, gpio_);
    return trigger_checks(observe_trigger(line, 3s, [this] { return gpio_.clock; }), rig_);
  }
  testing::FakeGpio gpio_;
  RigConfig rig_{.trigger = {.exposure_line = 17, .pps_line = 27}};
};

TEST_F(TriggerChecks, GoodLinesAreGood) {
  gpio_.add_pulses(17, 200, 33'333'333ns, 4ms);
  gpio_.add_pulses(27, 10, 1s, 50ms);
  const auto all = checks();
  for (const Check& check : all) EXPECT_EQ(check.verdict, Verdict::kOk) << check.name << check.fix;
  EXPECT_EQ(all.size(), 3U);
}

TEST_F(TriggerChecks, DeadLinesAreNamed) {
  const auto all = checks();
  EXPECT_EQ(check_named(all, "exposure edges").verdict, Verdict::kFail);
  EXPECT_THAT(check_named(all, "exposure edges").fix, HasSubstr("no edge on line 17"));
  EXPECT_THAT(check_named(all, "PPS edges").fix, HasSubstr("line 27"));
}

TEST_F(TriggerChecks, NoiseIsSeen) {
  gpio_.add_pulses(17, 400, 16ms, 4ms);
  EXPECT_EQ(check_named(checks(), "exposure edges").verdict, Verdict::kFail);
}

// Packets at a rate, and a position packet now and then.
class PacedLidar final : public Lidar {
 public:
  PacedLidar(HostTime& clock, double per_second) : clock_(clock), per_second_(per_second) {}
  Result<void> start() override { return {}; }
  std::optional<LidarMessage> read(std::chrono::nanoseconds patience) override {
    const bool speaks = per_second_ > 0.0;
    const std::chrono::nanoseconds step(static_cast<std::int64_t>(speaks ? 1e9 / per_second_ : 0));
    if (!speaks || step > patience) {
      clock_ += patience;
      return std::nullopt;
    }
    if (++messages_ % 15 == 0) return PositionPacket{.arrival = clock_};
    clock_ += step;
    ++counters_.packets;
    return LidarPacket{.arrival = clock_};
  }
  void stop() override {}
  DeviceState state() const override { return DeviceState::kStreaming; }
  LidarCounters counters() const override { return counters_; }

 private:
  HostTime& clock_;
  double per_second_;
  int messages_ = 0;
  LidarCounters counters_;
};

class ReportingDecoder final : public LidarDecoder {
 public:
  bool decode(const LidarPacket&, DecodedPacket&) override { return true; }
  std::optional<LidarClockReport> decode(const PositionPacket&) override { return report; }
  DecoderCounters counters() const override { return counted; }
  LidarClockReport report{.pps = PpsState::kLocked, .utc_valid = true};
  DecoderCounters counted;
};

class LidarChecks : public ::testing::Test {
 protected:
  std::vector<Check> checks(double per_second) {
    HostTime clock(1s);
    PacedLidar lidar(clock, per_second);
    return lidar_checks(observe_lidar(lidar, decoder_, 3s, [&] { return clock; }), rig_);
  }
  ReportingDecoder decoder_;
  RigConfig rig_;
};

TEST_F(LidarChecks, AGoodLidarIsGoodInEitherReturnMode) {
  for (const double rate : {753.5, 1507.0}) {
    for (const Check& check : checks(rate)) {
      EXPECT_EQ(check.verdict, Verdict::kOk) << check.name << check.found;
    }
  }
}

TEST_F(LidarChecks, TheConfiguredReturnModeIsExpected) {
  rig_.lidar.return_mode = ReturnMode::kStrongest;
  EXPECT_EQ(check_named(checks(1507.0), "lidar rate").verdict, Verdict::kFail);
}

TEST_F(LidarChecks, ASilentLidarSaysWhereToLook) {
  const auto all = checks(0.0);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all[0].fix, HasSubstr("tcpdump -n udp port 2368"));
}

TEST_F(LidarChecks, LossesAreWeighed) {
  decoder_.counted.lost = 3;
  EXPECT_EQ(check_named(checks(753.5), "lidar losses").verdict, Verdict::kWarn);
  decoder_.counted.lost = 100;
  EXPECT_EQ(check_named(checks(753.5), "lidar losses").verdict, Verdict::kFail);
}

TEST_F(LidarChecks, AbsentPpsFailsOnlyWhereItIsWired) {
  decoder_.report.pps = PpsState::kAbsent;
  EXPECT_EQ(check_named(checks(753.5), "lidar PPS").verdict, Verdict::kWarn);
  rig_.trigger.pps_output_line = 22;
  EXPECT_EQ(check_named(checks(753.5), "lidar PPS").verdict, Verdict::kFail);
}

}  // namespace
}  // namespace sparsight
