#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/v4l2/v4l2_camera.h"
#include "tests/contract/device_under_test.h"
#include "tests/drivers/gpio/fake_gpio.h"
#include "tests/drivers/v4l2/fake_video.h"

// The live drivers on a kernel that plays a part.
namespace sparsight::contract {
namespace {

CameraUnderTest v4l2_camera(const std::function<void(testing::FakeVideo&)>& prepare) {
  auto video = std::make_shared<testing::FakeVideo>();
  video->triggered = false;
  prepare(*video);
  CameraUnderTest test;
  test.world = video;
  test.device = std::make_unique<V4l2Camera>(CameraConfig{}, *video);
  test.feed = [video] { video->frames_to_come = 30; };
  test.now = [video] { return video->clock; };
  return test;
}

const bool kV4l2Added = add_camera({"V4l2", [] { return v4l2_camera([](auto&) {}); }});

const bool kV4l2InTroubleAdded = add_camera({"V4l2InTrouble", [] {
                                               return v4l2_camera([](testing::FakeVideo& video) {
                                                 video.troubles[3].lost = true;
                                                 video.troubles[5].error_flag = true;
                                                 video.troubles[6].missing_bytes = 100;
                                                 video.troubles[8].dequeue_errno = EIO;
                                                 video.troubles[12].source_changes = true;
                                                 video.troubles[15].lost = true;
                                               });
                                             }});

TriggerLineUnderTest gpio_trigger_line(const TriggerConfig& config) {
  auto gpio = std::make_shared<testing::FakeGpio>();
  TriggerLineUnderTest test;
  test.world = gpio;
  test.device = std::make_unique<GpioTriggerLine>(config, *gpio);
  test.feed = [gpio, config] {
    using namespace std::chrono_literals;
    gpio->add_pulses(config.exposure_line, 60, 33ms, 4ms);
    if (config.pps_line) gpio->add_pulses(*config.pps_line, 2, 990ms, 50ms);
  };
  test.now = [gpio] { return gpio->clock; };
  return test;
}

const bool kExposureLineAdded = add_trigger_line(
    {"GpioExposureActive", [] { return gpio_trigger_line({.exposure_line = 17}); }});
const bool kTriggerAndPpsAdded = add_trigger_line(
    {"GpioTriggerAndPps", [] {
       return gpio_trigger_line({.exposure_line = 17, .exposure_active = false, .pps_line = 27});
     }});

}  // namespace
}  // namespace sparsight::contract
