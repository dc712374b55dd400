#include "realtime/sync/arrival_envelope.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

namespace sparsight {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr SensorTime kEnvelopeSensor{seconds(100)};
constexpr HostTime kEnvelopeHost{seconds(2000)};

TEST(ArrivalEnvelope, IsTheLineThroughTwoUndelayedMessages) {
  ArrivalEnvelope envelope;
  envelope.add(kEnvelopeSensor, kEnvelopeHost);
  envelope.add(kEnvelopeSensor + seconds(1), kEnvelopeHost + seconds(1) + milliseconds(3));
  envelope.add(kEnvelopeSensor + seconds(2), kEnvelopeHost + seconds(2) + microseconds(100));
  const auto line = envelope.line();
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->rate, 1.0 + 50e-6, 1e-9);
  EXPECT_EQ(line->at(kEnvelopeSensor + seconds(1)), kEnvelopeHost + seconds(1) + microseconds(50));
  EXPECT_EQ(line->sensor_at(kEnvelopeHost), kEnvelopeSensor);
}

TEST(ArrivalEnvelope, KnowsNothingWithoutMessages) {
  EXPECT_FALSE(ArrivalEnvelope().line());
  EXPECT_FALSE(SlidingEnvelope().line());
}

TEST(ArrivalEnvelope, LeavesOutDeviceTimesThatDoNotGrow) {
  ArrivalEnvelope envelope;
  envelope.add(kEnvelopeSensor, kEnvelopeHost);
  envelope.add(kEnvelopeSensor, kEnvelopeHost - seconds(1));
  EXPECT_EQ(envelope.count(), 1U);
}

TEST(ArrivalEnvelope, HasNoSteeperLineThanACrystalCanDrift) {
  ArrivalEnvelope envelope;
  envelope.add(kEnvelopeSensor, kEnvelopeHost + milliseconds(100));
  envelope.add(kEnvelopeSensor + seconds(1), kEnvelopeHost + seconds(1));
  EXPECT_NEAR(envelope.line()->rate, 1.0 - 200e-6, 1e-12);
  EXPECT_LE(envelope.line()->at(kEnvelopeSensor + seconds(1)), kEnvelopeHost + seconds(1));
}

// Arrivals on an arc are all vertices of the hull.
TEST(ArrivalEnvelope, NeedsNoMoreMemoryForAnArc) {
  ArrivalEnvelope envelope;
  for (int i = 0; i < 5000; ++i) {
    const double x = i / 5000.0;
    envelope.add(kEnvelopeSensor + milliseconds(i),
                 kEnvelopeHost + milliseconds(i) + nanoseconds(std::llround(1e6 * x * x)));
  }
  // Chords of an arc lie above it by little.
  const auto line = envelope.line();
  const HostTime middle = kEnvelopeHost + milliseconds(2500) + microseconds(250);
  EXPECT_LT(std::chrono::abs(line->at(kEnvelopeSensor + milliseconds(2500)) - middle),
            microseconds(2));
}

RC_GTEST_PROP(ArrivalEnvelope, LiesBelowAllArrivals, (unsigned seed)) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> delay(1.0 / 1e6);
  std::vector<std::pair<SensorTime, HostTime>> messages;
  ArrivalEnvelope envelope;
  const int count = *rc::gen::inRange(1, 200);
  for (int i = 0; i < count; ++i) {
    messages.emplace_back(
        kEnvelopeSensor + i * milliseconds(10),
        kEnvelopeHost + i * milliseconds(10) + nanoseconds(std::llround(delay(random))));
    envelope.add(messages.back().first, messages.back().second);
  }
  for (const auto& [device, arrival] : messages) {
    RC_ASSERT(envelope.line()->at(device) <= arrival + nanoseconds(2));
  }
}

}  // namespace
}  // namespace sparsight
