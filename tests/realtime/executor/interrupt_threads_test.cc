#include "realtime/executor/interrupt_threads.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace sparsight {
namespace {

TEST(InterruptThreads, AreKnownByTheirNameAsTheKernelCutsIt) {
  EXPECT_TRUE(serves_interrupt("irq/24-sparsight", "sparsight"));
  EXPECT_TRUE(serves_interrupt("irq/24-sparsigh", "sparsight")) << "fifteen letters, cut";
  EXPECT_TRUE(serves_interrupt("irq/7-eth0", "eth0"));
  EXPECT_FALSE(serves_interrupt("irq/24-sparsig", "sparsight")) << "another driver's whole name";
  EXPECT_FALSE(serves_interrupt("irq/24-xhci_hcd", "sparsight"));
  EXPECT_FALSE(serves_interrupt("sparsight", "sparsight"));
  EXPECT_FALSE(serves_interrupt("", "sparsight"));
}

TEST(InterruptThreads, NoneIsNoProblem) {
  const auto proc = std::filesystem::path(::testing::TempDir()) / "interrupt_threads_none";
  std::filesystem::create_directories(proc / "1");
  std::ofstream(proc / "1" / "comm") << "init\n";
  EXPECT_FALSE(raise_interrupt_threads("sparsight", 85, proc));
  EXPECT_FALSE(raise_interrupt_threads("sparsight", 85, proc / "missing"));
}

TEST(InterruptThreads, WhatIsRefusedIsSaidWithTheThreadsName) {
  const auto proc = std::filesystem::path(::testing::TempDir()) / "interrupt_threads_refused";
  // A process number that the kernel never gives away.
  std::filesystem::create_directories(proc / "2000000000");
  std::ofstream(proc / "2000000000" / "comm") << "irq/24-sparsigh\n";
  const auto refused = raise_interrupt_threads("sparsight", 85, proc);
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->find("irq/24-sparsigh"), std::string::npos) << *refused;
}

}  // namespace
}  // namespace sparsight
