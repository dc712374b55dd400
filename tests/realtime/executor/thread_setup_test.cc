#include "realtime/executor/thread_setup.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <array>
#include <thread>

#include "tests/realtime/guard/realtime_guard.h"

namespace sparsight {
namespace {

// Thread settings die with their thread.
template <typename Run>
void in_a_thread(Run run) {
  std::thread(run).join();
}

TEST(SetUpThread, NamesTheThread) {
  in_a_thread([] {
    set_up_thread({.name = "a-name-of-more-than-15-letters"});
    std::array<char, 16> name{};
    pthread_getname_np(pthread_self(), name.data(), name.size());
    EXPECT_STREQ(name.data(), "a-name-of-more-");
  });
}

TEST(SetUpThread, KeepsItOnTheProcessorsItIsGiven) {
  in_a_thread([] {
    EXPECT_FALSE(set_up_thread({.name = "pinned", .cpus = {0}}).has_value());
    EXPECT_EQ(sched_getcpu(), 0);
  });
  in_a_thread([] {
    const auto refused = set_up_thread({.name = "pinned", .cpus = {1023}});
    ASSERT_TRUE(refused.has_value());
    EXPECT_NE(refused->find("pinned"), std::string::npos);
  });
}

TEST(SetUpThread, SchedulesInRealTimeOrSaysWhatItWouldTake) {
  in_a_thread([] {
    const auto refused = set_up_thread({.name = "rt", .fifo_priority = 10});
    int policy = 0;
    sched_param parameters{};
    pthread_getschedparam(pthread_self(), &policy, &parameters);
    if (refused) {
      EXPECT_NE(refused->find("CAP_SYS_NICE"), std::string::npos);
      EXPECT_EQ(policy, SCHED_OTHER);
    } else {
      EXPECT_EQ(policy, SCHED_FIFO);
      EXPECT_EQ(parameters.sched_priority, 10);
    }
  });
}

[[gnu::noinline]] long faults_of_deep_work() {
  const auto faults = [] {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_minflt + usage.ru_majflt;
  };
  const long before = faults();
  volatile char block[200 * 1024];
  for (std::size_t i = 0; i < sizeof block; i += 1024) block[i] = 1;
  return faults() - before;
}

TEST(SetUpThread, TouchesTheStackSoThatItFaultsNoMore) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "a sanitizer's own memory faults";
  long without = 0;
  long with = 0;
  in_a_thread([&] {
    set_up_thread({.name = "untouched", .stack_bytes = 0});
    without = faults_of_deep_work();
  });
  in_a_thread([&] {
    set_up_thread({.name = "touched", .stack_bytes = 512 * 1024});
    with = faults_of_deep_work();
  });
  EXPECT_GE(without, 10) << "or this test shows nothing";
  EXPECT_EQ(with, 0);
}

}  // namespace
}  // namespace sparsight
