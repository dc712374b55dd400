#include "tests/realtime/guard/realtime_guard.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdint>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define SPARSIGHT_UNGUARDED 1
#endif
#endif
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define SPARSIGHT_UNGUARDED 1
#endif

namespace sparsight {
namespace {

thread_local bool guarded = false;
thread_local RealtimeOffences found;
thread_local long faults_before = 0;

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

#if defined(__x86_64__) && defined(PR_SET_SYSCALL_USER_DISPATCH) && !defined(SPARSIGHT_UNGUARDED)

constexpr long kSystemCallBytes = 2;  // of the instruction: 0f 05
thread_local volatile char dispatch = SYSCALL_DISPATCH_FILTER_ALLOW;

// The call has not been made. It is counted, and made after all: the signal handler's own return is
// a system call too, so the trap stays open from here on.
void on_system_call(int, siginfo_t*, void* context) {
  ++found.system_calls;
  dispatch = SYSCALL_DISPATCH_FILTER_ALLOW;
  auto* interrupted = static_cast<ucontext_t*>(context);
  interrupted->uc_mcontext.gregs[REG_RIP] -= kSystemCallBytes;
}

bool trap_system_calls(bool on) {
  struct sigaction action {};
  action.sa_sigaction = on_system_call;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  const int mode = on ? PR_SYS_DISPATCH_ON : PR_SYS_DISPATCH_OFF;
  return prctl(PR_SET_SYSCALL_USER_DISPATCH, mode, 0, 0, on ? &dispatch : nullptr) == 0;
}
void open_trap() { dispatch = SYSCALL_DISPATCH_FILTER_ALLOW; }
void close_trap() { dispatch = SYSCALL_DISPATCH_FILTER_BLOCK; }

#else

bool trap_system_calls(bool) { return false; }
void open_trap() {}
void close_trap() {}

#endif

}  // namespace

bool RealtimeGuard::available() {
#ifdef SPARSIGHT_UNGUARDED
  return false;
#else
  return true;
#endif
}

bool RealtimeGuard::traps_system_calls() {
  const bool works = trap_system_calls(true);
  trap_system_calls(false);
  return works;
}

RealtimeGuard::RealtimeGuard(bool system_calls) {
  found = {};
  const bool trapped = system_calls && trap_system_calls(true);
  faults_before = page_faults();
  guarded = true;
  if (trapped) close_trap();
}

RealtimeGuard::~RealtimeGuard() {
  open_trap();
  guarded = false;
  trap_system_calls(false);
}

RealtimeOffences RealtimeGuard::offences() const {
  open_trap();
  guarded = false;
  RealtimeOffences result = found;
  result.page_faults = page_faults() - faults_before;
  return result;
}

}  // namespace sparsight

#ifndef SPARSIGHT_UNGUARDED

namespace {

void note(int sparsight::RealtimeOffences::*what) {
  if (sparsight::guarded) ++(sparsight::found.*what);
}

// The C library's function that ours stands in front of.
template <typename Function>
Function next_of(Function, const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t size);
void __libc_free(void* block);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  note(&sparsight::RealtimeOffences::allocations);
  return __libc_malloc(size);
}
void free(void* block) {
  if (block != nullptr) note(&sparsight::RealtimeOffences::allocations);
  __libc_free(block);
}
void* calloc(std::size_t count, std::size_t size) {
  note(&sparsight::RealtimeOffences::allocations);
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  note(&sparsight::RealtimeOffences::allocations);
  return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  note(&sparsight::RealtimeOffences::allocations);
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  note(&sparsight::RealtimeOffences::allocations);
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  note(&sparsight::RealtimeOffences::allocations);
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static const auto next = next_of(&pthread_mutex_trylock, "pthread_mutex_lock");
  note(&sparsight::RealtimeOffences::locks);
  return next(mutex);
}
int pthread_rwlock_rdlock(pthread_rwlock_t* lock) {
  static const auto next = next_of(&pthread_rwlock_tryrdlock, "pthread_rwlock_rdlock");
  note(&sparsight::RealtimeOffences::locks);
  return next(lock);
}
int pthread_rwlock_wrlock(pthread_rwlock_t* lock) {
  static const auto next = next_of(&pthread_rwlock_trywrlock, "pthread_rwlock_wrlock");
  note(&sparsight::RealtimeOffences::locks);
  return next(lock);
}

int open(const char* path, int flags, ...) {
  note(&sparsight::RealtimeOffences::file_calls);
  std::va_list arguments;
  va_start(arguments, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(arguments, int) : 0;
  va_end(arguments);
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
ssize_t read(int fd, void* buffer, std::size_t size) {
  note(&sparsight::RealtimeOffences::file_calls);
  return syscall(SYS_read, fd, buffer, size);
}
ssize_t write(int fd, const void* buffer, std::size_t size) {
  note(&sparsight::RealtimeOffences::file_calls);
  return syscall(SYS_write, fd, buffer, size);
}

}  // extern "C"

#endif
