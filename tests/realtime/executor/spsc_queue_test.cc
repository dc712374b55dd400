#include "realtime/executor/spsc_queue.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

#include "realtime/executor/latest_value.h"

namespace sparsight {
namespace {

TEST(SpscQueue, GivesBackInOrderAndRefusesWhenFull) {
  SpscQueue<int> queue(4);
  auto producer = queue.producer();
  auto consumer = queue.consumer();
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(producer.try_push(i));
  EXPECT_FALSE(producer.try_push(4));
  EXPECT_EQ(queue.size(), 4U);
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(*consumer.front(), i);
    EXPECT_TRUE(consumer.try_pop(value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(consumer.try_pop(value));
  EXPECT_EQ(consumer.front(), nullptr);
}

TEST(SpscQueue, LeavesAValueThatDoesNotFitWithItsOwner) {
  SpscQueue<std::unique_ptr<int>> queue(1);
  EXPECT_TRUE(queue.producer().try_push(std::make_unique<int>(1)));
  auto second = std::make_unique<int>(2);
  EXPECT_FALSE(queue.producer().try_push(std::move(second)));
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(*second, 2);
}

// For the thread sanitizer: what was put in is seen whole by who takes it out.
TEST(SpscQueue, LosesAndTearsNothingBetweenTwoThreads) {
  struct Wide {
    std::uint64_t a = 0;
    std::uint64_t b = 0;
  };
  constexpr std::uint64_t kCount = 50'000;
  SpscQueue<Wide> queue(8);
  std::thread producer([&] {
    auto end = queue.producer();
    for (std::uint64_t i = 1; i <= kCount; ++i) {
      while (!end.try_push(Wide{i, ~i})) std::this_thread::yield();
    }
  });
  auto end = queue.consumer();
  Wide wide;
  for (std::uint64_t i = 1; i <= kCount; ++i) {
    while (!end.try_pop(wide)) std::this_thread::yield();
    ASSERT_EQ(wide.a, i);
    ASSERT_EQ(wide.b, ~i);
  }
  producer.join();
  EXPECT_EQ(queue.size(), 0U);
}

TEST(LatestValue, GivesTheNewestAndSaysWhetherItIsNew) {
  LatestValue<int> latest(7);
  EXPECT_FALSE(latest.refresh());
  EXPECT_EQ(latest.value(), 7);
  for (int i = 0; i < 5; ++i) {
    latest.draft() = i;
    latest.publish();
  }
  EXPECT_TRUE(latest.refresh());
  EXPECT_EQ(latest.value(), 4);
  EXPECT_FALSE(latest.refresh());
  EXPECT_EQ(latest.value(), 4);
}

// For the thread sanitizer: what is read is never being written.
TEST(LatestValue, IsNeverTornAndNeverGoesBackBetweenTwoThreads) {
  constexpr std::uint64_t kCount = 50'000;
  LatestValue<std::array<std::uint64_t, 16>> latest;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kCount; ++i) {
      latest.draft().fill(i);
      latest.publish();
    }
  });
  std::uint64_t last = 0;
  while (last < kCount) {
    if (!latest.refresh()) {
      std::this_thread::yield();
      continue;
    }
    const auto& value = latest.value();
    ASSERT_GT(value.front(), last);
    for (const std::uint64_t v : value) ASSERT_EQ(v, value.front());
    last = value.front();
  }
  writer.join();
}

}  // namespace
}  // namespace sparsight
