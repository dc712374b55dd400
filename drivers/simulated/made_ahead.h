#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <utility>

namespace sparsight::simulated {

// Makes numbered things on threads of their own before they are asked for; they come in the order
// of their numbers. What is made depends on the number alone. Thread-bound.
template <typename T>
class MadeAhead {
 public:
  MadeAhead(std::function<T(std::uint64_t)> make, std::size_t ahead)
      : make_(std::move(make)), ahead_(ahead) {}

  // `next` follows the number asked for before or lies beyond it; those between are left out.
  T take(std::uint64_t number, std::uint64_t end) {
    while (!made_.empty() && made_.front().first < number) made_.pop_front();
    next_ = std::max(next_, number);
    fill(end);
    T result = made_.front().second.get();
    made_.pop_front();
    fill(end);
    return result;
  }

 private:
  void fill(std::uint64_t end) {
    for (; made_.size() < ahead_ && next_ < end; ++next_) {
      made_.emplace_back(next_, std::async(std::launch::async, make_, next_));
    }
  }

  std::function<T(std::uint64_t)> make_;
  std::size_t ahead_;
  std::uint64_t next_ = 0;
  std::deque<std::pair<std::uint64_t, std::future<T>>> made_;
};

}  // namespace sparsight::simulated
