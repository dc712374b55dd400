#include "realtime/executor/interrupt_threads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

const Interrupts kLines{.names = {"sparsight"}};

// Of this test in this process: others may run beside it.
fs::path fresh_folder(const char* name) {
  const auto folder = fs::path(::testing::TempDir()) / (name + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void write_line(const fs::path& file, const std::string& line) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << line << "\n";
}

TEST(InterruptThreads, AreKnownByTheirNameAsTheKernelCutsIt) {
  EXPECT_TRUE(serves_interrupt("irq/24-sparsight", kLines));
  EXPECT_TRUE(serves_interrupt("irq/24-sparsigh", kLines)) << "fifteen letters, cut";
  EXPECT_TRUE(serves_interrupt("irq/7-eth0", {.names = {"eth0"}}));
  EXPECT_TRUE(serves_interrupt("irq/125-eth0-rx", {.names = {"eth0"}})) << "one of its queues";
  EXPECT_TRUE(serves_interrupt("irq/24-s-sparsi", kLines)) << "the second half of a handler";
  EXPECT_FALSE(serves_interrupt("irq/125-eth01", {.names = {"eth0"}}));
  EXPECT_FALSE(serves_interrupt("irq/24-sparsig", kLines)) << "another driver's whole name";
  EXPECT_FALSE(serves_interrupt("irq/24-xhci_hcd", kLines));
  EXPECT_FALSE(serves_interrupt("sparsight", kLines));
  EXPECT_FALSE(serves_interrupt("", kLines));
}

TEST(InterruptThreads, AreKnownByTheirNumber) {
  const Interrupts interrupts{.numbers = {24, 125}};
  EXPECT_TRUE(serves_interrupt("irq/24-xhci_hcd", interrupts));
  EXPECT_TRUE(serves_interrupt("irq/125-s-xhci_", interrupts));
  EXPECT_FALSE(serves_interrupt("irq/2-xhci_hcd", interrupts));
  EXPECT_FALSE(serves_interrupt("irq/245-xhci_hc", interrupts));
  EXPECT_FALSE(serves_interrupt("irq/x-24", interrupts));
}

TEST(InterruptThreads, NoneIsNoProblem) {
  const auto proc = fresh_folder("interrupt_threads_none");
  write_line(proc / "1" / "comm", "init");
  EXPECT_FALSE(raise_interrupt_threads(kLines, 85, proc));
  EXPECT_FALSE(raise_interrupt_threads(kLines, 85, proc / "missing"));
}

TEST(InterruptThreads, WhatIsRefusedIsSaidWithTheThreadsName) {
  const auto proc = fresh_folder("interrupt_threads_refused");
  // A process number that the kernel never gives away.
  write_line(proc / "2000000000" / "comm", "irq/24-sparsigh");
  const auto refused = raise_interrupt_threads(kLines, 85, proc);
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->find("irq/24-sparsigh"), std::string::npos) << *refused;
  EXPECT_FALSE(raise_interrupt_threads({}, 85, proc)) << "of no interrupt";
}

// A thread of the test's stands in for the kernel's.
TEST(InterruptThreads, AreRaisedAndNeverLowered) {
  const auto priority = [] {
    sched_param parameters{};
    sched_getparam(gettid(), &parameters);
    return sched_getscheduler(gettid()) == SCHED_FIFO ? parameters.sched_priority : 0;
  };
  std::optional<std::string> refused;
  int raised = 0;
  int raised_again = 0;
  std::thread([&] {
    const auto proc = fresh_folder("interrupt_threads_raised");
    write_line(proc / std::to_string(gettid()) / "comm", "irq/24-eth0");
    refused = raise_interrupt_threads({.numbers = {24}}, 75, proc);
    raised = priority();
    raise_interrupt_threads({.numbers = {24}}, 67, proc);
    raised_again = priority();
  }).join();
  if (refused) GTEST_SKIP() << *refused;
  EXPECT_EQ(raised, 75);
  EXPECT_EQ(raised_again, 75) << "a camera beside the network on one controller";
}

// A folder as /sys has it, of a device and all it hangs on.
class InterruptsBehind : public testing::Test {
 protected:
  void SetUp() override { sys_ = fresh_folder("interrupts_behind"); }

  // As /sys/class names it, which is a link.
  fs::path device(const std::string& below_devices) const {
    const fs::path at = sys_ / "devices" / below_devices;
    fs::create_directories(at);
    const fs::path link = sys_ / "class" / at.filename();
    fs::create_directories(link.parent_path());
    fs::create_directory_symlink(at, link);
    return link;
  }
  void interrupt(const std::string& below_devices, const std::string& line) const {
    write_line(sys_ / "devices" / below_devices, line);
  }

  fs::path sys_;
};

TEST_F(InterruptsBehind, AreThoseOfTheControllerThatACameraHangsOn) {
  const auto camera = device("pci0000:00/0000:00:14.0/usb1/1-3/1-3:1.0/video4linux/video0");
  interrupt("pci0000:00/0000:00:14.0/irq", "41");
  interrupt("pci0000:00/0000:00:14.0/msi_irqs/125", "msi");
  EXPECT_THAT(interrupts_behind(camera).numbers, ElementsAre(125));
}

TEST_F(InterruptsBehind, AreAllQueuesOfANetworkCard) {
  const auto card = device("pci0000:00/0000:00:1c.0/0000:02:00.0/net/enp2s0");
  interrupt("pci0000:00/0000:00:1c.0/irq", "18");  // of the bridge before it
  for (const char* queue : {"130", "131", "132"}) {
    interrupt(std::string("pci0000:00/0000:00:1c.0/0000:02:00.0/msi_irqs/") + queue, "msix");
  }
  EXPECT_THAT(interrupts_behind(card).numbers, UnorderedElementsAre(130, 131, 132));
}

TEST_F(InterruptsBehind, IsTheWireWithoutMessages) {
  const auto card = device("pci0000:00/0000:00:03.0/net/eth0");
  interrupt("pci0000:00/0000:00:03.0/irq", "11");
  const Interrupts found = interrupts_behind(card);
  EXPECT_THAT(found.numbers, ElementsAre(11));
  EXPECT_THAT(found.names, IsEmpty());
}

TEST_F(InterruptsBehind, AreCalledAsTheFoldersWhereThereAreNoNumbers) {
  const auto card = device("platform/scb/fd580000.ethernet/net/end0");
  interrupt("platform/scb/fd580000.ethernet/irq", "0");
  const Interrupts found = interrupts_behind(card);
  EXPECT_THAT(found.numbers, IsEmpty());
  EXPECT_THAT(found.names, Contains("end0"));
  EXPECT_THAT(found.names, Contains("fd580000.ethernet"));
}

TEST_F(InterruptsBehind, AreNoneOfADeviceThatIsNotThere) {
  const Interrupts found = interrupts_behind(sys_ / "class" / "video7");
  EXPECT_THAT(found.numbers, IsEmpty());
  EXPECT_THAT(found.names, IsEmpty());
  EXPECT_THAT(interrupts_behind("").names, IsEmpty());
}

}  // namespace
}  // namespace sparsight
