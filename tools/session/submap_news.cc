#include "tools/session/submap_news.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sparsight {
namespace {

std::size_t index_of(const std::vector<Submap>& submaps, std::uint64_t first_keyframe) {
  return static_cast<std::size_t>(
      std::ranges::find(submaps, first_keyframe, &Submap::first_keyframe) - submaps.begin());
}

}  // namespace

std::vector<std::string> SubmapNews::of(const LoopCloser& loops) {
  if (std::exchange(joined_, loops.statistics().submaps_joined) == joined_) return {};
  const std::vector<Submap> before = std::exchange(submaps_, loops.submaps());
  std::vector<std::string> news;
  for (std::size_t i = 0; i < submaps_.size(); ++i) {
    const std::uint64_t part = i < before.size() ? before[i].part : submaps_[i].first_keyframe;
    if (submaps_[i].part == part) continue;
    news.push_back(fmt::format("found: sub-map {} lies in sub-map {}, as loops with it show", i,
                               index_of(submaps_, submaps_[i].part)));
  }
  return news;
}

}  // namespace sparsight
