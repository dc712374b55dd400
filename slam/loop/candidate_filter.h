#pragma once

#include <cstdint>
#include <vector>

#include "slam/loop/place_database.h"

namespace sparsight {

// Keeps what several queries in a row agree about: a single image finds look-alikes, a walk past a
// place finds the place again and again. Thread-bound.
class CandidateFilter {
 public:
  explicit CandidateFilter(int consistent_queries) : consistent_queries_(consistent_queries) {}

  // The matches of the next keyframe, the most similar first. Returns the places that are
  // consistent with the queries before, in that order; of neighbours only the most similar.
  std::vector<std::uint32_t> next(const std::vector<PlaceMatch>& matches);

 private:
  struct Run {
    std::uint32_t place = 0;
    int length = 0;  // queries in a row
  };
  int run_before(std::uint32_t place) const;

  int consistent_queries_;
  std::vector<Run> last_;
};

}  // namespace sparsight
