#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "slam/loop/binary_descriptor.h"

namespace sparsight {

// What a view shows: words and how much they say of it, ascending by word; the weights add up to 1.
struct WordWeight {
  std::uint32_t word = 0;
  float weight = 0.0F;
};
using BagOfWords = std::vector<WordWeight>;

// Similarity of two views, 0 to 1: 1 - |a - b|_1 / 2 (Galvez-Lopez and Tardos, "Bags of binary
// words for fast place recognition in image sequences", T-RO 2012, eq. (2)).
double similarity(const BagOfWords& a, const BagOfWords& b);

// A tree over binary descriptors; its leaves are words with their inverse document frequency
// (ibid., Sec. III).
class Vocabulary {
 public:
  struct Node {
    BinaryDescriptor descriptor{};
    std::uint32_t first_child = 0;  // children stand together; none: a word
    std::uint32_t children = 0;
    std::uint32_t word = 0;  // of a leaf
    float weight = 0.0F;     // of a leaf
  };

  // Nodes breadth first, the root before all.
  Vocabulary(int branches, int levels, std::vector<Node> nodes);

  // The text that ORB-SLAM's vocabularies come in: "k L scoring weighting", then a line per node
  // with parent, leaf, 32 bytes and weight. `source` names it in errors.
  static Result<Vocabulary> from_text(std::string_view text, const std::string& source);
  // Our own form, a fifth of the text's size; see vocabulary.cc.
  static Result<Vocabulary> from_bytes(std::string_view bytes, const std::string& source);
  std::string to_bytes() const;

  std::uint32_t word_of(const BinaryDescriptor& descriptor) const;
  BagOfWords bag_of(std::span<const BinaryDescriptor> descriptors) const;

  std::size_t words() const { return words_; }
  int branches() const { return branches_; }
  int levels() const { return levels_; }
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  const Node& leaf_of(const BinaryDescriptor& descriptor) const;

  int branches_;
  int levels_;
  std::vector<Node> nodes_;
  std::size_t words_ = 0;
};

}  // namespace sparsight
