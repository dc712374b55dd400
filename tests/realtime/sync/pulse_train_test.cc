#include "realtime/sync/pulse_train.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr HostTime kTrainStart{std::chrono::seconds(50)};

void add_pulses(PulseTrain& train, int first, int count, milliseconds period = milliseconds(100)) {
  for (int i = first; i < first + count; ++i) {
    train.add(kTrainStart + i * period, milliseconds(1), false);
  }
}

TEST(PulseTrain, BelievesAPeriodAfterFourEqualIntervals) {
  PulseTrain train;
  add_pulses(train, 0, 4);
  EXPECT_FALSE(train.regular());
  add_pulses(train, 4, 1);
  ASSERT_TRUE(train.regular());
  EXPECT_EQ(train.period(), milliseconds(100));
  EXPECT_EQ(train.last_index(), 4);
  EXPECT_EQ(train.place_of(10).time, kTrainStart + milliseconds(1000));
}

TEST(PulseTrain, DoesNotLearnAcrossALostPulse) {
  PulseTrain train;
  add_pulses(train, 0, 3);
  add_pulses(train, 4, 4);
  EXPECT_FALSE(train.regular());
  add_pulses(train, 8, 1);
  EXPECT_TRUE(train.regular());
}

TEST(PulseTrain, KeepsThePlacesOfLostPulses) {
  PulseTrain train;
  add_pulses(train, 0, 6);
  add_pulses(train, 9, 1);
  EXPECT_EQ(train.last_index(), 9);
  EXPECT_EQ(train.counters().lost, 3U);
  EXPECT_FALSE(train.find(7));
  EXPECT_TRUE(train.find(9));
}

TEST(PulseTrain, DoubtsBothOfTwoPulsesAtOnePlace) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  train.add(kTrainStart + milliseconds(703), milliseconds(1), false);
  EXPECT_TRUE(train.find(7)->doubtful);
  EXPECT_EQ(train.find(7)->off, milliseconds(3));
  EXPECT_FALSE(train.find(6)->doubtful);
}

TEST(PulseTrain, DoubtsAPulseThatIsOffItsPlace) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  train.add(kTrainStart + milliseconds(805), milliseconds(1), false);
  EXPECT_TRUE(train.find(8)->doubtful);
  EXPECT_EQ(train.place_of(9).time, kTrainStart + milliseconds(900));
}

TEST(PulseTrain, IgnoresOneStranger) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  train.add(kTrainStart + milliseconds(750), milliseconds(1), false);
  add_pulses(train, 8, 8);
  EXPECT_TRUE(train.regular());
  EXPECT_EQ(train.generation(), 1U);
  EXPECT_EQ(train.last_index(), 15);
  EXPECT_EQ(train.counters().strange, 1U);
}

TEST(PulseTrain, BeginsANewCountWhenPulsesMoveToANewPhase) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  for (int i = 0; i < 6; ++i) {
    train.add(kTrainStart + milliseconds(850 + 100 * i), milliseconds(1), false);
  }
  EXPECT_TRUE(train.regular());
  EXPECT_EQ(train.generation(), 2U);
  EXPECT_NEAR(train.index_at(kTrainStart + milliseconds(1350)), 4.0, 2.0);
}

TEST(PulseTrain, DisputesAnEmptyPlaceBesideAStranger) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  train.add(kTrainStart + milliseconds(845), milliseconds(1), false);
  EXPECT_TRUE(train.disputed(8));
  EXPECT_FALSE(train.disputed(7));
}

TEST(PulseTrain, BeginsANewCountAfterALongPause) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  add_pulses(train, 100, 1);
  EXPECT_FALSE(train.regular());
  add_pulses(train, 101, 4);
  EXPECT_TRUE(train.regular());
  EXPECT_EQ(train.generation(), 2U);
}

TEST(PulseTrain, FindsTheTruePeriodAfterHavingLearnedTwiceThat) {
  PulseTrain train;
  add_pulses(train, 0, 8, milliseconds(200));
  add_pulses(train, 15, 40, milliseconds(100));
  EXPECT_TRUE(train.regular());
  EXPECT_EQ(train.period(), milliseconds(100));
}

TEST(PulseTrain, RecoversFromAPulseInTheFarFuture) {
  PulseTrain train;
  add_pulses(train, 0, 8);
  train.add(kTrainStart + std::chrono::hours(1), milliseconds(1), false);
  add_pulses(train, 8, 8);
  EXPECT_TRUE(train.regular());
  EXPECT_EQ(train.period(), milliseconds(100));
}

TEST(PulseTrain, IsLessSureOfPlacesFartherAhead) {
  PulseTrain train;
  for (int i = 0; i < 32; ++i) {
    const nanoseconds jitter((i * 7919) % 41'000 - 20'000);
    train.add(kTrainStart + i * milliseconds(100) + jitter, milliseconds(1), false);
  }
  EXPECT_GT(train.place_of(60).sigma, train.place_of(33).sigma);
  EXPECT_GT(train.place_of(33).sigma, train.jitter());
}

}  // namespace
}  // namespace sparsight
