#include "tests/realtime/guard/realtime_guard.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

namespace sparsight {
namespace {

// Each trap fires: without this, that nothing was found would say nothing.
class RealtimeGuardTraps : public testing::Test {
 protected:
  void SetUp() override {
    if (!RealtimeGuard::available()) GTEST_SKIP() << "not under a sanitizer";
  }
};

TEST_F(RealtimeGuardTraps, NothingWhereNothingIsDone) {
  volatile double sum = 0.0;
  RealtimeOffences found;
  {
    const RealtimeGuard guard;
    for (int i = 0; i < 1000; ++i) sum = sum + 1.0;
    found = guard.offences();
  }
  EXPECT_FALSE(found.any());
}

TEST_F(RealtimeGuardTraps, AllocationsOfEveryKind) {
  std::vector<int> growing;
  growing.reserve(1);
  std::unique_ptr<int> made;
  struct alignas(64) Wide {
    int value = 0;
  };
  std::unique_ptr<Wide> wide;
  RealtimeOffences by_new;
  RealtimeOffences by_growth;
  RealtimeOffences by_free;
  RealtimeOffences aligned;
  {
    const RealtimeGuard guard;
    made = std::make_unique<int>(1);
    by_new = guard.offences();
  }
  {
    const RealtimeGuard guard;
    growing.resize(100);
    by_growth = guard.offences();
  }
  {
    const RealtimeGuard guard;
    made.reset();
    by_free = guard.offences();
  }
  {
    const RealtimeGuard guard;
    wide = std::make_unique<Wide>();
    aligned = guard.offences();
  }
  EXPECT_EQ(by_new.allocations, 1);
  EXPECT_EQ(by_growth.allocations, 2) << "the new block, and the old one's end";
  EXPECT_EQ(by_free.allocations, 1);
  EXPECT_EQ(aligned.allocations, 1);
}

TEST_F(RealtimeGuardTraps, LocksEvenWhereNobodyHoldsThem) {
  std::mutex mutex;
  std::shared_mutex shared;
  RealtimeOffences found;
  {
    const RealtimeGuard guard;
    { const std::lock_guard lock(mutex); }
    { const std::unique_lock lock(shared); }
    { const std::shared_lock lock(shared); }
    found = guard.offences();
  }
  EXPECT_EQ(found.locks, 3);
}

TEST_F(RealtimeGuardTraps, Files) {
  RealtimeOffences found;
  {
    const RealtimeGuard guard;
    const int fd = open("/dev/null", O_RDWR);
    char byte = 0;
    const bool done = write(fd, &byte, 1) == 1 && read(fd, &byte, 1) == 0;
    found = guard.offences();
    close(fd);
    EXPECT_TRUE(done);
  }
  EXPECT_GE(found.file_calls, 3);
}

TEST_F(RealtimeGuardTraps, PageFaults) {
  constexpr std::size_t kBytes = 64 * 4096;
  void* fresh = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(fresh, MAP_FAILED);
  RealtimeOffences found;
  {
    const RealtimeGuard guard;
    for (std::size_t i = 0; i < kBytes; i += 4096) static_cast<volatile char*>(fresh)[i] = 1;
    found = guard.offences();
  }
  EXPECT_GE(found.page_faults, 1);
  munmap(fresh, kBytes);
}

TEST_F(RealtimeGuardTraps, WhatTheCLibraryDoesWithinItself) {
  if (!RealtimeGuard::traps_system_calls()) GTEST_SKIP() << "this kernel cannot report them";
  std::FILE* null = std::fopen("/dev/null", "w");
  ASSERT_NE(null, nullptr);
  std::setvbuf(null, nullptr, _IONBF, 0);
  RealtimeOffences found;
  {
    const RealtimeGuard guard;
    std::fputs("logged\n", null);
    found = guard.offences();
  }
  EXPECT_EQ(found.system_calls, 1);
  std::fclose(null);
}

TEST_F(RealtimeGuardTraps, NothingOnceItHasEnded) {
  { const RealtimeGuard guard; }
  auto made = std::make_unique<int>(1);
  const RealtimeGuard guard;
  EXPECT_EQ(guard.offences().allocations, 0);
}

}  // namespace
}  // namespace sparsight
