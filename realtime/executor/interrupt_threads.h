#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sparsight {

// A PREEMPT_RT kernel serves interrupts by threads, "irq/24-NAME", of SCHED_FIFO 50: one that feeds
// a thread of ours must stand above it, or what it delivers waits for whatever else runs at 51 and
// more. Gives all of this name the priority; NAME as the driver was told it, which the kernel cuts
// to what fits. Says what was refused, in words for an operator; other kernels have no such
// threads, and nothing is wrong with that.
std::optional<std::string> raise_interrupt_threads(std::string_view name, int fifo_priority,
                                                   const std::filesystem::path& proc = "/proc");

// Whether this is the thread of an interrupt of that name, by what /proc/PID/comm says.
bool serves_interrupt(std::string_view comm, std::string_view name);

}  // namespace sparsight
