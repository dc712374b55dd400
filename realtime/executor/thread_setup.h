#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sparsight {

struct ThreadSettings {
  std::string name;                      // as top and gdb show it; the first 15 letters
  std::optional<int> fifo_priority;      // SCHED_FIFO, 1 to 99; nothing: as the system has it
  std::vector<int> cpus;                 // it may run on; all if none is given
  std::size_t stack_bytes = 256 * 1024;  // touched now, so that no page faults later
};

// Gives these settings to the calling thread, which no longer takes SIGINT, SIGTERM and SIGHUP.
// Says what was refused and what would help, in words for an operator; the thread is as good as the
// rest allows.
std::optional<std::string> set_up_thread(const ThreadSettings& settings);

// For the whole process, before its threads start: freed memory stays with it and large blocks come
// from the same heap, so that a buffer once used faults no more; `heap_bytes` of it are touched
// now; and nothing is paged out. Likewise says what was refused.
std::optional<std::string> set_up_memory(std::size_t heap_bytes);

}  // namespace sparsight
