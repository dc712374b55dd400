#pragma once

#include "slam/tracking/search_budget.h"

namespace sparsight {

// So many steps of each kind, and how many were asked for.
class CountedBudget final : public SearchBudget {
 public:
  static constexpr int kAny = 1 << 20;
  CountedBudget(int rank, int follow) : left_{rank, follow} {}

  bool allows(Step step) noexcept override { return asked(step)++ < left_[index(step)]; }
  int& asked(Step step) { return asked_[index(step)]; }

 private:
  static int index(Step step) { return static_cast<int>(step); }
  int left_[2];
  int asked_[2] = {0, 0};
};

}  // namespace sparsight
