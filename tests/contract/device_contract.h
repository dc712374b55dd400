#pragma once

#include <gtest/gtest.h>

#include "tests/contract/device_under_test.h"

namespace sparsight::contract {

// What every device owes whoever reads it, whatever it delivers. The suites of cameras, LiDARs and
// trigger lines each run all of it.
template <typename Device>
class DeviceContract : public ::testing::TestWithParam<Implementation<Device>> {
 protected:
  Device& device() { return *test_.device; }
  bool live() const { return this->GetParam().nature == DeviceNature::kLive; }
  void start() {
    const auto started = device().start();
    ASSERT_TRUE(started) << started.error().message;
    test_.feed();
  }

  void is_stopped_and_yields_nothing() {
    EXPECT_EQ(device().state(), DeviceState::kStopped);
    const HostTime before = test_.now();
    EXPECT_FALSE(device().read(std::chrono::hours(1))) << "a stopped device does not wait";
    EXPECT_LT(test_.now() - before, kSlack);
    EXPECT_EQ(device().state(), DeviceState::kStopped);
  }

  void goes_through_its_states() {
    EXPECT_EQ(device().state(), DeviceState::kStopped);
    start();
    EXPECT_TRUE(runs()) << "after its start";
    read_until_it_streams();
    read_all(device());
    const HostTime give_up = test_.now() + std::chrono::seconds(5);
    while (device().state() == DeviceState::kStreaming && test_.now() < give_up) {
      EXPECT_FALSE(device().read(kPatience));
    }
    EXPECT_EQ(device().state(), live() ? DeviceState::kSilent : DeviceState::kEnded);
    EXPECT_FALSE(device().read(std::chrono::nanoseconds(0)));
    device().stop();
    EXPECT_EQ(device().state(), DeviceState::kStopped);
  }

  void starting_twice_is_starting_once() {
    start();
    EXPECT_TRUE(device().start());
    const std::size_t twice = read_all(device()).size();
    test_ = this->GetParam().make();
    start();
    EXPECT_EQ(read_all(device()).size(), twice);
  }

  void stopping_twice_is_stopping_once() {
    device().stop();
    is_stopped_and_yields_nothing();
    start();
    EXPECT_TRUE(device().read(kPatience));
    device().stop();
    device().stop();
    is_stopped_and_yields_nothing();
  }

  void starts_again_after_a_stop() {
    start();
    EXPECT_TRUE(device().read(kPatience));
    device().stop();
    start();
    read_until_it_streams();
  }

  // However long it is told to wait, and above all when told not to.
  void keeps_its_patience() {
    using namespace std::chrono_literals;
    start();
    for (const auto patience : {50ms, 0ms}) {
      for (int i = 0; i < 5; ++i) timed_read(patience);
    }
    read_all(device());
    timed_read(0ms);
    const auto waited = timed_read(120ms);
    if (live()) {
      EXPECT_GE(waited, 119ms) << "it gave up early";
    }
  }

  DeviceUnderTest<Device> test_ = this->GetParam().make();

 private:
  static constexpr std::chrono::nanoseconds kSlack = std::chrono::seconds(2);

  bool runs() {
    const DeviceState state = device().state();
    return state == DeviceState::kStreaming || state == DeviceState::kSilent;
  }
  // The first to come may be what makes no stream, as a LiDAR's position packet.
  void read_until_it_streams() {
    constexpr int kEnough = 10;
    for (int i = 0; i < kEnough && device().state() != DeviceState::kStreaming; ++i) {
      EXPECT_TRUE(device().read(kPatience));
    }
    EXPECT_EQ(device().state(), DeviceState::kStreaming);
  }
  std::chrono::nanoseconds timed_read(std::chrono::nanoseconds patience) {
    const HostTime before = test_.now();
    device().read(patience);
    const auto waited = test_.now() - before;
    EXPECT_LE(waited, patience + kSlack);
    return waited;
  }
};

}  // namespace sparsight::contract

// The tests of DeviceContract in the suite of one kind of device.
// NOLINTBEGIN(cppcoreguidelines-macro-usage): GoogleTest's TEST_P takes no template
#define SPARSIGHT_DEVICE_CONTRACT(Suite)                                               \
  TEST_P(Suite, IsStoppedAtFirstAndYieldsNothing) { is_stopped_and_yields_nothing(); } \
  TEST_P(Suite, GoesThroughItsStates) { goes_through_its_states(); }                   \
  TEST_P(Suite, StartingTwiceIsStartingOnce) { starting_twice_is_starting_once(); }    \
  TEST_P(Suite, StoppingTwiceIsStoppingOnce) { stopping_twice_is_stopping_once(); }    \
  TEST_P(Suite, StartsAgainAfterAStop) { starts_again_after_a_stop(); }                \
  TEST_P(Suite, KeepsItsPatience) { keeps_its_patience(); }
// NOLINTEND(cppcoreguidelines-macro-usage)
