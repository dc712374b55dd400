#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/loop/vocabulary.h"

namespace sparsight {

struct PlaceMatch {
  std::uint32_t place = 0;  // in the order they were added
  float similarity = 0.0F;
};

// Places by the words they show: an inverted file. Thread-bound.
class PlaceDatabase {
 public:
  explicit PlaceDatabase(std::size_t words) : shown_in_(words) {}

  std::uint32_t add(const BagOfWords& bag);
  std::size_t size() const { return size_; }

  // Places before `end` at least `least` similar to the view, the most similar first; at most
  // `wanted`.
  std::vector<PlaceMatch> query(const BagOfWords& view, std::size_t end, double least,
                                std::size_t wanted) const;

 private:
  std::vector<std::vector<PlaceMatch>> shown_in_;  // per word: places and the word's weight there
  std::size_t size_ = 0;
};

}  // namespace sparsight
