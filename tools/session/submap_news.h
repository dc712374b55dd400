#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "slam/loop/loop_closer.h"

namespace sparsight {

// What a person is told when sub-maps are joined, and when that was wrong. Thread-bound.
class SubmapNews {
 public:
  // Since the call before.
  std::vector<std::string> of(const LoopCloser& loops);

 private:
  std::size_t joined_ = 0;
  std::size_t revised_ = 0;
  std::vector<Submap> submaps_;  // as they were
};

}  // namespace sparsight
