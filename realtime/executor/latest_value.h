#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace sparsight {

// The newest of what one thread says, for one other thread: a triple buffer. The writer never waits
// for the reader, nor the reader for the writer; what comes too fast is overwritten unseen. Nothing
// is allocated but what T itself allocates in the writer's draft. Real-time-safe for the reader.
//
// Each of three slots belongs to the writer, to the reader, or stands in the middle. An exchange
// of the middle's index hands over a whole slot: release, so that what was written in it is seen by
// whoever takes it, and acquire, so that the slot received in exchange is no longer being read or
// written by the other side.
template <typename T>
class LatestValue {
 public:
  explicit LatestValue(const T& initial = T()) : slots_{initial, initial, initial} {}
  LatestValue(const LatestValue&) = delete;
  LatestValue& operator=(const LatestValue&) = delete;

  // The writer's. What is in the draft is what was there two publications ago.
  T& draft() noexcept { return slots_[drafting_]; }
  void publish() noexcept {
    drafting_ = middle_.exchange(drafting_ | kNew, std::memory_order_acq_rel) & kIndex;
  }

  // The reader's. True if there is something newer than what value() was.
  bool refresh() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  // Stands until the next refresh().
  const T& value() const noexcept { return slots_[reading_]; }

 private:
  static constexpr std::uint8_t kNew = 4;
  static constexpr std::uint8_t kIndex = 3;

  std::array<T, 3> slots_;
  std::uint8_t drafting_ = 0;  // the writer's
  std::uint8_t reading_ = 1;   // the reader's
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace sparsight
