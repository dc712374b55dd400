#pragma once

#include <array>
#include <chrono>

#include "hal/time.h"
#include "realtime/executor/loop_clock.h"
#include "slam/tracking/search_budget.h"

namespace sparsight {

struct SearchDeadlineConfig {
  // What a step takes at most, until it has taken more.
  std::chrono::nanoseconds rank{500'000};
  std::chrono::nanoseconds follow{8'000'000};
  double memory = 0.98;  // what is left of that after each search that needed less
};

// The time that a frame has left for a search: no step begins that would not end by then, going by
// the longest of its kind lately; and no start is ranked if none could be followed afterwards.
// Thread-bound, real-time-safe.
class SearchDeadline final : public SearchBudget {
 public:
  explicit SearchDeadline(LoopClock& clock, const SearchDeadlineConfig& config = {})
      : clock_(clock), memory_(config.memory), kinds_{Kind{config.rank}, Kind{config.follow}} {}

  // The first search may come late; what only a search touches is to be there then.
  void rehearse() noexcept;
  // Of the next frame.
  void begin(HostTime deadline) noexcept;
  bool allows(Step step) noexcept override;
  // The frame has its pose. True if a search was cut short.
  bool end() noexcept;

 private:
  struct Kind {
    std::chrono::nanoseconds expected;
    std::chrono::nanoseconds longest{0};  // of this search
  };
  Kind& kind(Step step) noexcept { return kinds_[static_cast<std::size_t>(step)]; }
  void finish_step(HostTime now) noexcept;

  LoopClock& clock_;
  double memory_;
  std::array<Kind, 2> kinds_;  // by Step
  HostTime deadline_;
  HostTime step_begun_;
  Kind* running_ = nullptr;
  bool searched_ = false;
  bool refused_ = false;
};

}  // namespace sparsight
