#include "slam/loop/place_database.h"

#include <algorithm>

namespace sparsight {

std::uint32_t PlaceDatabase::add(const BagOfWords& bag) {
  const auto place = static_cast<std::uint32_t>(size_++);
  for (const WordWeight& one : bag) shown_in_[one.word].push_back({place, one.weight});
  return place;
}

std::vector<PlaceMatch> PlaceDatabase::query(const BagOfWords& view, std::size_t end, double least,
                                             std::size_t wanted) const {
  // The similarity is the sum over common words of the smaller weight; see similarity().
  std::vector<float> sums(std::min(end, size_), 0.0F);
  for (const WordWeight& one : view) {
    for (const PlaceMatch& shown : shown_in_[one.word]) {
      if (shown.place >= sums.size()) break;  // places stand in their order
      sums[shown.place] += std::min(one.weight, shown.similarity);
    }
  }
  std::vector<PlaceMatch> matches;
  for (std::size_t place = 0; place < sums.size(); ++place) {
    if (sums[place] > 0.0F && static_cast<double>(sums[place]) >= least) {
      matches.push_back({static_cast<std::uint32_t>(place), sums[place]});
    }
  }
  const auto better = [](const PlaceMatch& a, const PlaceMatch& b) {
    return a.similarity != b.similarity ? a.similarity > b.similarity : a.place < b.place;
  };
  const std::size_t kept = std::min(wanted, matches.size());
  std::partial_sort(matches.begin(), matches.begin() + static_cast<std::ptrdiff_t>(kept),
                    matches.end(), better);
  matches.resize(kept);
  return matches;
}

}  // namespace sparsight
