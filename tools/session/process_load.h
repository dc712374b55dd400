#pragma once

#include <chrono>
#include <cstdint>

namespace sparsight {

// Of this process, all threads.
std::chrono::nanoseconds processor_time();
std::uint64_t resident_bytes();

}  // namespace sparsight
