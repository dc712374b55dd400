#pragma once

#include <cstdint>

namespace sparsight {

// What a search for the pose may still do. It asks before each step and ends with what it has where
// the answer is no; so whoever has a clock keeps it from beginning what it cannot end in time.
class SearchBudget {
 public:
  enum class Step : std::uint8_t {
    kRank,    // a starting motion tried by a few patches of the coarsest level
    kFollow,  // a promising one taken to the coarsest minimum, and if that is new to the finest
  };

  virtual ~SearchBudget() = default;
  virtual bool allows(Step step) noexcept = 0;
};

}  // namespace sparsight
