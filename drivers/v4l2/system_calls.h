#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/time.h"

namespace sparsight {

// The part of the kernel that a camera driver speaks to, so that tests can take the kernel's place.
// Failures are negative errno values; a call that a signal interrupts is made again.
class SystemCalls {
 public:
  virtual ~SystemCalls() = default;
  virtual int open(const std::string& path) = 0;  // for reading and writing, non-blocking
  virtual void close(int fd) = 0;
  virtual int ioctl(int fd, unsigned long request, void* argument) = 0;
  virtual void* map(int fd, std::size_t length, std::uint32_t offset) = 0;  // nullptr: failed
  virtual void unmap(void* address, std::size_t length) = 0;
  // The events that have come; 0 if none has within `patience`.
  virtual int poll(int fd, short events, std::chrono::nanoseconds patience) = 0;
  virtual void sleep(std::chrono::nanoseconds duration) = 0;
  virtual HostTime now() = 0;
};

SystemCalls& linux_calls();

}  // namespace sparsight
