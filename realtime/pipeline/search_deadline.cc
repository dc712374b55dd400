#include "realtime/pipeline/search_deadline.h"

#include <algorithm>
#include <cstdint>

namespace sparsight {

void SearchDeadline::rehearse() noexcept {
  const std::array<Kind, 2> kinds = kinds_;
  begin(HostTime::max());
  for (const Step step : {Step::kRank, Step::kFollow}) allows(step);
  end();
  kinds_ = kinds;
}

void SearchDeadline::begin(HostTime deadline) noexcept {
  deadline_ = deadline;
  running_ = nullptr;
  searched_ = refused_ = false;
  for (Kind& kind : kinds_) kind.longest = {};
}

bool SearchDeadline::allows(Step step) noexcept {
  const HostTime now = clock_.now();
  finish_step(now);
  searched_ = true;
  std::chrono::nanoseconds needed = kind(step).expected;
  if (step == Step::kRank) needed += kind(Step::kFollow).expected;
  if (now + needed > deadline_) {
    refused_ = true;
    return false;
  }
  running_ = &kind(step);
  step_begun_ = now;
  return true;
}

bool SearchDeadline::end() noexcept {
  if (!searched_) return false;
  finish_step(clock_.now());
  for (Kind& kind : kinds_) {
    const auto remembered =
        static_cast<std::int64_t>(memory_ * static_cast<double>(kind.expected.count()));
    kind.expected = std::max(kind.longest, std::chrono::nanoseconds(remembered));
  }
  return refused_;
}

void SearchDeadline::finish_step(HostTime now) noexcept {
  if (!running_) return;
  running_->longest = std::max(running_->longest, now - step_begun_);
  running_->expected = std::max(running_->expected, running_->longest);
  running_ = nullptr;
}

}  // namespace sparsight
