#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sparsight {

// A stage's sign of life: beaten once in each round of its loop. Real-time-safe.
class Heartbeat {
 public:
  // Relaxed: it is looked at by itself.
  void beat() noexcept { beats_.fetch_add(1, std::memory_order_relaxed); }
  std::uint64_t beats() const noexcept { return beats_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> beats_{0};
};

// Which of the stages still advance. Thread-bound; the heartbeats outlive it.
class LivenessCheck {
 public:
  void watch(std::string name, const Heartbeat& heart) {
    watched_.push_back({std::move(name), &heart, heart.beats()});
  }
  // The names of those that have not advanced since the call before.
  std::vector<std::string> standing_still() {
    std::vector<std::string> names;
    for (Watched& watched : watched_) {
      const std::uint64_t beats = watched.heart->beats();
      if (beats == std::exchange(watched.seen, beats)) names.push_back(watched.name);
    }
    return names;
  }

 private:
  struct Watched {
    std::string name;
    const Heartbeat* heart;
    std::uint64_t seen;
  };
  std::vector<Watched> watched_;
};

}  // namespace sparsight
