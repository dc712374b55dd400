#include "realtime/executor/thread_setup.h"

#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <memory>

namespace sparsight {
namespace {

constexpr std::size_t kPage = 4096;
// What is locked is all there; eight megabytes a thread would be too much.
constexpr std::size_t kThreadStack = std::size_t{2} << 20;
constexpr std::size_t kMostStackTouched = std::size_t{1} << 20;

// Not to be inlined: its frame is the stack that is touched.
[[gnu::noinline]] void touch_stack(std::size_t bytes) {
  constexpr std::size_t kStep = 16 * kPage;
  volatile std::uint8_t block[kStep];
  for (std::size_t i = 0; i < kStep; i += kPage) block[i] = 0;
  if (bytes > kStep) touch_stack(bytes - kStep);
  asm volatile("" : : "r"(block) : "memory");  // it is used: no tail call, no leaving out
}

void touch_heap(std::size_t bytes) {
  if (bytes == 0) return;
  const std::unique_ptr<std::uint8_t[]> block(new std::uint8_t[bytes]);
  volatile std::uint8_t* touched = block.get();
  for (std::size_t i = 0; i < bytes; i += kPage) touched[i] = 0;
}

// Within a limit it would succeed, and the first memory beyond it would be refused in mid-run.
bool may_lock_all() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  return geteuid() == 0 || limit.rlim_cur == RLIM_INFINITY;
}

std::string refused(const std::string& what, int error) { return what + ": " + strerror(error); }

}  // namespace

std::optional<std::string> set_up_thread(const ThreadSettings& settings) {
  std::optional<std::string> problem;
  // Requests to end are the main thread's; no wait of this one is to be interrupted by them.
  sigset_t requests;
  sigemptyset(&requests);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&requests, signal);
  pthread_sigmask(SIG_BLOCK, &requests, nullptr);
  pthread_setname_np(pthread_self(), settings.name.substr(0, 15).c_str());
  if (!settings.cpus.empty()) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : settings.cpus) {
      if (cpu >= 0 && cpu < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(cpu), &set);
    }
    if (const int error = pthread_setaffinity_np(pthread_self(), sizeof set, &set)) {
      problem = refused(settings.name + " cannot be kept on the processors it is given", error);
    }
  }
  if (settings.fifo_priority) {
    const sched_param parameters{.sched_priority = *settings.fifo_priority};
    if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters)) {
      problem = refused(
          "no real-time scheduling, so other programs may delay this one; give "
          "CAP_SYS_NICE, or LimitRTPRIO=95 in the service",
          error);
    }
  }
  touch_stack(std::min(settings.stack_bytes, kMostStackTouched));
  return problem;
}

std::optional<std::string> set_up_memory(std::size_t heap_bytes) {
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_MMAP_MAX, 0);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kThreadStack);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  std::optional<std::string> problem;
  // What is touched stays; the rest of the libraries, hundreds of megabytes of them, need not come.
  if (!may_lock_all() || mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0) {
    problem =
        "memory cannot be locked, so it may be paged out; give LimitMEMLOCK=infinity in the "
        "service";
  }
  touch_heap(heap_bytes);
  return problem;
}

}  // namespace sparsight
