#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sparsight {

// Interrupts by their numbers, or by their names as drivers gave them to the kernel.
struct Interrupts {
  std::vector<int> numbers;
  std::vector<std::string> names;
};

// Those by which the data of a device come, by its folder under /sys: the device's own or those of
// the nearest controller it hangs on, as a USB camera has none. Where the system tells no numbers,
// as for devices that are no PCI's, the folders' names: drivers call their interrupts so.
Interrupts interrupts_behind(const std::filesystem::path& device);

// A PREEMPT_RT kernel serves interrupts by threads, "irq/24-NAME", of SCHED_FIFO 50: one that feeds
// a thread of ours must stand above it, or what it delivers waits for whatever else runs at 51 and
// more. Gives these the priority where they have less. Says what was refused, in words for an
// operator; other kernels have no such threads, and nothing is wrong with that.
std::optional<std::string> raise_interrupt_threads(const Interrupts& interrupts, int fifo_priority,
                                                   const std::filesystem::path& proc = "/proc");

// Whether this is the thread of one of them, by what /proc/PID/comm says; of a name the kernel
// keeps what fits.
bool serves_interrupt(std::string_view comm, const Interrupts& interrupts);

}  // namespace sparsight
