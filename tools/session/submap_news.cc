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
  const LoopStatistics& statistics = loops.statistics();
  std::vector<std::string> news;
  if (std::exchange(revised_, statistics.joins_revised) != statistics.joins_revised) {
    news.emplace_back(
        "two sub-maps were joined wrongly, as more loops show; they stand as those say");
  }
  if (std::exchange(joined_, statistics.submaps_joined) == statistics.submaps_joined) return news;
  const std::vector<Submap> before = std::exchange(submaps_, loops.submaps());
  for (std::size_t i = 0; i < submaps_.size(); ++i) {
    const bool in_earlier_map = i < before.size() && before[i].in_earlier_map;
    if (submaps_[i].in_earlier_map) {
      if (in_earlier_map) continue;
      news.push_back(fmt::format("found: sub-map {} lies in the earlier map", i));
      continue;
    }
    const std::uint64_t part = i < before.size() ? before[i].part : submaps_[i].first_keyframe;
    if (submaps_[i].part == part) continue;
    news.push_back(fmt::format("found: sub-map {} lies in sub-map {}, as loops with it show", i,
                               index_of(submaps_, submaps_[i].part)));
  }
  return news;
}

}  // namespace sparsight
