#pragma once

namespace sparsight {

// What a piece of code did that a real-time thread must not do.
struct RealtimeOffences {
  int allocations = 0;   // malloc and its kin, operator new, free
  int locks = 0;         // of a mutex or a read-write lock; waits for a condition
  int file_calls = 0;    // open, read, write, close
  int system_calls = 0;  // of any kind; the first is counted, then they are let through
  long page_faults = 0;

  bool any() const {
    return allocations + locks + file_calls + system_calls > 0 || page_faults > 0;
  }
};

// Traps what the calling thread does while one lives. The program that is linked with it has its
// own malloc, pthread_mutex_lock, open and write in front of the C library's; and on x86-64 the
// kernel reports every system call of the thread (man 2 prctl, PR_SET_SYSCALL_USER_DISPATCH), so
// that nothing escapes that the C library does within itself, such as logging. Not under
// sanitizers, which need these functions themselves.
class RealtimeGuard {
 public:
  // system_calls: false where the code under test may make some.
  explicit RealtimeGuard(bool system_calls = true);
  ~RealtimeGuard();
  RealtimeGuard(const RealtimeGuard&) = delete;
  RealtimeGuard& operator=(const RealtimeGuard&) = delete;

  RealtimeOffences offences() const;

  static bool available();
  static bool traps_system_calls();
};

}  // namespace sparsight
