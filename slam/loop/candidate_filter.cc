#include "slam/loop/candidate_filter.h"

#include <algorithm>
#include <utility>

namespace sparsight {
namespace {

constexpr std::int64_t kSamePlace = 5;  // keyframes

bool near(std::uint32_t a, std::uint32_t b) {
  return std::abs(static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b)) <= kSamePlace;
}

}  // namespace

int CandidateFilter::run_before(std::uint32_t place) const {
  int longest = 0;
  for (const Run& run : last_) {
    if (near(run.place, place)) longest = std::max(longest, run.length);
  }
  return longest;
}

std::vector<std::uint32_t> CandidateFilter::next(const std::vector<PlaceMatch>& matches) {
  std::vector<Run> runs;
  std::vector<std::uint32_t> consistent;
  for (const PlaceMatch& match : matches) {
    const int length = 1 + run_before(match.place);
    runs.push_back({match.place, length});
    const bool known = std::ranges::any_of(
        consistent, [&](std::uint32_t place) { return near(place, match.place); });
    if (length >= consistent_queries_ && !known) consistent.push_back(match.place);
  }
  last_ = std::move(runs);
  return consistent;
}

}  // namespace sparsight
