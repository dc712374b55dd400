#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace sparsight {

// What a histogram held at one moment. Durations are known to 1/16 of their size.
struct LatencySnapshot {
  static constexpr std::size_t kBuckets = 368;  // 16 an octave, from 1 us to 16 s

  std::array<std::uint64_t, kBuckets> counts{};
  std::uint64_t count = 0;
  std::chrono::nanoseconds max{0};

  // The upper edge of the bucket that holds the smallest value which at least `share` of them do
  // not exceed; zero of none. Never above the largest value.
  std::chrono::nanoseconds percentile(double share) const;
  // What was added since `earlier`; its largest value is not known, so `max` stays.
  LatencySnapshot since(const LatencySnapshot& earlier) const;
};

// Durations counted in buckets of fixed number. One thread adds, real-time-safe; any may look.
class LatencyHistogram {
 public:
  void add(std::chrono::nanoseconds duration) noexcept;
  LatencySnapshot snapshot() const noexcept;

 private:
  // Relaxed throughout: each count stands for itself, nothing else is published by it.
  std::array<std::atomic<std::uint64_t>, LatencySnapshot::kBuckets> counts_{};
  std::atomic<std::int64_t> max_ns_{0};
};

}  // namespace sparsight
