#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace sparsight {

// A ring between two threads, of fixed capacity, without a lock; both ends only try. Real-time-safe
// where moving a T is. One thread holds the producer's end, one the consumer's.
//
// Memory order: an end writes its own index with release after it has touched the slot, and reads
// the other's with acquire before it touches one. So the consumer sees what was put in, and the
// producer sees that what was in the slot has been taken out. An end reads its own index relaxed:
// nobody else writes it. Each end remembers the other's index and looks at it only when the ring
// seems full or empty, so that the two cache lines seldom travel.
template <typename T>
class SpscQueue {
 public:
  class Producer {
   public:
    explicit Producer(SpscQueue& queue) : queue_(queue) {}
    // False, and `value` as it was, if the queue is full.
    bool try_push(T&& value) noexcept { return queue_.try_push(std::move(value)); }
    bool try_push(const T& value) noexcept { return queue_.try_push(T(value)); }

   private:
    SpscQueue& queue_;
  };

  class Consumer {
   public:
    explicit Consumer(SpscQueue& queue) : queue_(queue) {}
    bool try_pop(T& value) noexcept { return queue_.try_pop(value); }
    // The oldest, left in; null if there is none.
    T* front() noexcept { return queue_.front(); }
    // At least so many wait.
    std::size_t waiting() const noexcept { return queue_.size(); }

   private:
    SpscQueue& queue_;
  };

  // Room for at least `capacity` elements, made now.
  explicit SpscQueue(std::size_t capacity)
      : slots_(std::bit_ceil(capacity < 1 ? std::size_t{1} : capacity)) {}
  SpscQueue(const SpscQueue&) = delete;
  SpscQueue& operator=(const SpscQueue&) = delete;

  Producer producer() { return Producer(*this); }
  Consumer consumer() { return Consumer(*this); }
  std::size_t capacity() const noexcept { return slots_.size(); }
  // A moment's count; for any thread.
  std::size_t size() const noexcept {
    const std::size_t taken = taken_.load(std::memory_order_acquire);
    return put_.load(std::memory_order_acquire) - taken;
  }

 private:
  static constexpr std::size_t kCacheLine = 64;

  T& slot(std::size_t index) noexcept { return slots_[index & (slots_.size() - 1)]; }

  bool try_push(T&& value) noexcept {
    const std::size_t put = put_.load(std::memory_order_relaxed);
    if (put - taken_seen_ == slots_.size()) {
      taken_seen_ = taken_.load(std::memory_order_acquire);
      if (put - taken_seen_ == slots_.size()) return false;
    }
    slot(put) = std::move(value);
    put_.store(put + 1, std::memory_order_release);
    return true;
  }

  T* front() noexcept {
    const std::size_t taken = taken_.load(std::memory_order_relaxed);
    if (taken == put_seen_) {
      put_seen_ = put_.load(std::memory_order_acquire);
      if (taken == put_seen_) return nullptr;
    }
    return &slot(taken);
  }

  bool try_pop(T& value) noexcept {
    T* oldest = front();
    if (oldest == nullptr) return false;
    value = std::move(*oldest);
    taken_.store(taken_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    return true;
  }

  std::vector<T> slots_;
  alignas(kCacheLine) std::atomic<std::size_t> put_{0};    // written by the producer
  std::size_t taken_seen_ = 0;                             // the producer's
  alignas(kCacheLine) std::atomic<std::size_t> taken_{0};  // written by the consumer
  std::size_t put_seen_ = 0;                               // the consumer's
};

}  // namespace sparsight
