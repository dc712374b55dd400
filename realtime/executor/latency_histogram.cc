#include "realtime/executor/latency_histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sparsight {
namespace {

constexpr unsigned kStepsLog2 = 4;  // 16 buckets an octave
constexpr std::uint64_t kSteps = 1U << kStepsLog2;
constexpr std::int64_t kUnit_ns = 1000;

// Up to 32 us in steps of one, then by the leading five bits.
std::size_t bucket_of(std::chrono::nanoseconds duration) {
  const auto us =
      static_cast<std::uint64_t>(std::max<std::int64_t>(duration.count(), 0) / kUnit_ns);
  if (us < 2 * kSteps) return us;
  const auto octave = static_cast<unsigned>(std::bit_width(us)) - 1 - kStepsLog2;
  const std::size_t bucket = kSteps * octave + (us >> octave);
  return std::min(bucket, LatencySnapshot::kBuckets - 1);
}

std::chrono::nanoseconds upper_edge(std::size_t bucket) {
  if (bucket < 2 * kSteps) {
    return std::chrono::nanoseconds(kUnit_ns * (static_cast<std::int64_t>(bucket) + 1));
  }
  const std::size_t octave = bucket / kSteps - 1;
  const std::size_t leading = bucket - kSteps * octave;
  return std::chrono::nanoseconds(kUnit_ns * static_cast<std::int64_t>((leading + 1) << octave));
}

}  // namespace

std::chrono::nanoseconds LatencySnapshot::percentile(double share) const {
  const auto wanted = std::max<std::uint64_t>(
      1, static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count))));
  std::uint64_t seen = 0;
  for (std::size_t bucket = 0; bucket < counts.size(); ++bucket) {
    seen += counts[bucket];
    if (seen >= wanted) return std::min(upper_edge(bucket), max);
  }
  return std::chrono::nanoseconds(0);
}

LatencySnapshot LatencySnapshot::since(const LatencySnapshot& earlier) const {
  LatencySnapshot result = *this;
  result.count -= earlier.count;
  for (std::size_t i = 0; i < counts.size(); ++i) result.counts[i] -= earlier.counts[i];
  return result;
}

void LatencyHistogram::add(std::chrono::nanoseconds duration) noexcept {
  std::atomic<std::uint64_t>& count = counts_[bucket_of(duration)];
  // One thread adds: no read-modify-write is needed.
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  if (duration.count() > max_ns_.load(std::memory_order_relaxed)) {
    max_ns_.store(duration.count(), std::memory_order_relaxed);
  }
}

LatencySnapshot LatencyHistogram::snapshot() const noexcept {
  LatencySnapshot result;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    result.counts[i] = counts_[i].load(std::memory_order_relaxed);
    result.count += result.counts[i];
  }
  result.max = std::chrono::nanoseconds(max_ns_.load(std::memory_order_relaxed));
  return result;
}

}  // namespace sparsight
