#include "slam/loop/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace sparsight {
namespace {

using Node = Vocabulary::Node;

constexpr int kMostBranches = 64;
constexpr int kMostLevels = 10;
constexpr std::size_t kMostNodes = 20'000'000;
constexpr float kHighestWeight = 1e6F;

// The binary form, little endian: magic, branches, levels, number of nodes, and per node but the
// root, breadth first: number of its children (one byte), 32 bytes of descriptor, and the weight of
// a leaf as a float. The root's number of children follows the header.
constexpr std::string_view kMagic = "SPVOC001";
constexpr std::size_t kHeaderBytes = 8 + 1 + 1 + 4 + 1;

// Where its node stands in a text: parents come before their children, siblings need not be
// together.
struct TextNode {
  std::size_t parent = 0;
  bool leaf = false;
  BinaryDescriptor descriptor{};
  float weight = 0.0F;
};

class TextReader {
 public:
  TextReader(std::string_view text, const std::string& source) : rest_(text), source_(source) {}

  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (line_.find_first_not_of(" \t\r") != std::string_view::npos) return true;
    }
    return false;
  }

  template <typename Number>
  bool read(Number& value) {
    line_.remove_prefix(std::min(line_.find_first_not_of(" \t\r"), line_.size()));
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    const auto used = static_cast<std::size_t>(end - line_.data());
    const bool ends =
        used == line_.size() || line_[used] == ' ' || line_[used] == '\t' || line_[used] == '\r';
    line_.remove_prefix(used);
    return error == std::errc{} && ends;
  }

  bool at_end() const { return line_.find_first_not_of(" \t\r") == std::string_view::npos; }

  tl::unexpected<Error> refuse(std::string_view problem) const {
    return fail(ErrorCode::kMalformed, fmt::format("{}:{}: {}", source_, number_, problem));
  }

 private:
  std::string_view rest_;
  std::string_view line_;
  std::size_t number_ = 0;
  const std::string& source_;
};

bool usable(float weight) { return weight >= 0.0F && weight <= kHighestWeight; }

bool read_node(TextReader& reader, TextNode& node) {
  int leaf = 0;
  if (!reader.read(node.parent) || !reader.read(leaf) || leaf < 0 || leaf > 1) return false;
  node.leaf = leaf == 1;
  for (std::size_t i = 0; i < kDescriptorBytes; ++i) {
    int byte = 0;
    if (!reader.read(byte) || byte < 0 || byte > 255) return false;
    set_descriptor_byte(node.descriptor, i, static_cast<std::uint8_t>(byte));
  }
  return reader.read(node.weight) && usable(node.weight) && reader.at_end();
}

// Nodes in the order of the text to nodes breadth first, siblings together in their order.
std::vector<Node> breadth_first(const std::vector<TextNode>& texts) {
  std::vector<std::vector<std::uint32_t>> children(texts.size());
  for (std::size_t i = 1; i < texts.size(); ++i) {
    children[texts[i].parent].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<Node> nodes(1);
  std::vector<std::uint32_t> text_of{0};
  for (std::size_t at = 0; at < nodes.size(); ++at) {
    const std::vector<std::uint32_t>& below = children[text_of[at]];
    nodes[at].first_child = static_cast<std::uint32_t>(nodes.size());
    nodes[at].children = static_cast<std::uint32_t>(below.size());
    for (const std::uint32_t child : below) {
      nodes.push_back({.descriptor = texts[child].descriptor, .weight = texts[child].weight});
      text_of.push_back(child);
    }
  }
  return nodes;
}

void append_u32(std::string& bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i)));
}

std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    value |= std::uint32_t{static_cast<std::uint8_t>(bytes[at + i])} << (8 * i);
  }
  return value;
}

std::uint8_t u8_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

}  // namespace

double similarity(const BagOfWords& a, const BagOfWords& b) {
  // |a - b|_1 = 2 + sum over common words of |a - b| - a - b.
  double sum = 0.0;
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() && in_b != b.end()) {
    if (in_a->word < in_b->word) {
      ++in_a;
    } else if (in_b->word < in_a->word) {
      ++in_b;
    } else {
      sum += std::min(in_a->weight, in_b->weight);
      ++in_a;
      ++in_b;
    }
  }
  return sum;
}

Vocabulary::Vocabulary(int branches, int levels, std::vector<Node> nodes)
    : branches_(branches), levels_(levels), nodes_(std::move(nodes)) {
  for (Node& node : nodes_) {
    if (node.children == 0) node.word = static_cast<std::uint32_t>(words_++);
  }
}

Result<Vocabulary> Vocabulary::from_text(std::string_view text, const std::string& source) {
  TextReader reader(text, source);
  int branches = 0;
  int levels = 0;
  int scoring = 0;
  int weighting = 0;
  if (!reader.next_line() || !reader.read(branches) || !reader.read(levels) ||
      !reader.read(scoring) || !reader.read(weighting) || !reader.at_end() || branches < 2 ||
      branches > kMostBranches || levels < 1 || levels > kMostLevels) {
    return reader.refuse(
        fmt::format("a vocabulary begins with branches (2-{}), levels (1-{}), scoring and "
                    "weighting, as in '10 6 0 0'",
                    kMostBranches, kMostLevels));
  }
  std::vector<TextNode> texts(1);
  std::vector<int> children(1, 0);
  std::vector<int> depth(1, 0);
  while (reader.next_line()) {
    TextNode node;
    if (!read_node(reader, node)) {
      return reader.refuse("a node is its parent, 1 or 0 for a leaf, 32 bytes and a weight");
    }
    if (node.parent >= texts.size() || (node.parent > 0 && texts[node.parent].leaf)) {
      return reader.refuse(fmt::format("there is no inner node {} above this line", node.parent));
    }
    if (++children[node.parent] > branches || depth[node.parent] >= levels) {
      return reader.refuse(fmt::format(
          "node {} has more children, or more above it, than line 1 allows", node.parent));
    }
    if (texts.size() >= kMostNodes) return reader.refuse("there are too many nodes");
    texts.push_back(node);
    children.push_back(0);
    depth.push_back(depth[node.parent] + 1);
  }
  if (texts.size() < 2) return reader.refuse("there are no nodes");
  return Vocabulary(branches, levels, breadth_first(texts));
}

std::string Vocabulary::to_bytes() const {
  std::string bytes(kMagic);
  bytes.push_back(static_cast<char>(branches_));
  bytes.push_back(static_cast<char>(levels_));
  append_u32(bytes, static_cast<std::uint32_t>(nodes_.size()));
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    bytes.push_back(static_cast<char>(node.children));
    if (i == 0) continue;
    for (std::size_t byte = 0; byte < kDescriptorBytes; ++byte) {
      bytes.push_back(static_cast<char>(descriptor_byte(node.descriptor, byte)));
    }
    if (node.children == 0) append_u32(bytes, std::bit_cast<std::uint32_t>(node.weight));
  }
  return bytes;
}

Result<Vocabulary> Vocabulary::from_bytes(std::string_view bytes, const std::string& source) {
  const auto refuse = [&](std::size_t at, std::string_view problem) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: byte {}: {}; make it again with sparsight train-vocabulary",
                            source, at, problem));
  };
  if (bytes.size() < kHeaderBytes || !bytes.starts_with(kMagic)) {
    return refuse(0, "this is not the beginning of a vocabulary");
  }
  const int branches = u8_at(bytes, 8);
  const int levels = u8_at(bytes, 9);
  const std::size_t count = u32_at(bytes, 10);
  if (branches < 2 || branches > kMostBranches || levels < 1 || levels > kMostLevels || count < 2 ||
      count > bytes.size() / (1 + kDescriptorBytes) + 1) {
    return refuse(8, "branches, levels or number of nodes cannot be");
  }
  std::vector<Node> nodes;
  nodes.reserve(count);
  std::uint32_t announced = 1;  // nodes that the ones read so far have for children, and the root
  std::size_t at = kHeaderBytes - 1;
  while (nodes.size() < count) {
    const bool root = nodes.empty();
    if (bytes.size() - at < (root ? 1 : 1 + kDescriptorBytes)) return refuse(at, "it is cut off");
    Node node{.first_child = announced, .children = u8_at(bytes, at++)};
    announced += node.children;
    if (node.children > static_cast<std::uint32_t>(branches) || announced > count ||
        (nodes.size() + 1 == announced && nodes.size() + 1 < count)) {
      return refuse(at - 1, "this number of children cannot be");
    }
    for (std::size_t i = 0; !root && i < kDescriptorBytes; ++i) {
      set_descriptor_byte(node.descriptor, i, u8_at(bytes, at++));
    }
    if (node.children == 0) {
      if (bytes.size() - at < 4) return refuse(at, "it is cut off");
      node.weight = std::bit_cast<float>(u32_at(bytes, at));
      if (!usable(node.weight)) return refuse(at, "this weight cannot be");
      at += 4;
    }
    nodes.push_back(node);
  }
  if (announced != count) return refuse(at, "nodes are missing");
  if (at != bytes.size()) return refuse(at, "there is more than the nodes announced");
  return Vocabulary(branches, levels, std::move(nodes));
}

const Node& Vocabulary::leaf_of(const BinaryDescriptor& descriptor) const {
  const Node* node = &nodes_.front();
  while (node->children > 0) {
    const Node* nearest = nullptr;
    int shortest = std::numeric_limits<int>::max();
    for (std::uint32_t i = 0; i < node->children; ++i) {
      const Node& child = nodes_[node->first_child + i];
      const int distance = hamming_distance(child.descriptor, descriptor);
      if (distance < shortest) {
        shortest = distance;
        nearest = &child;
      }
    }
    node = nearest;
  }
  return *node;
}

std::uint32_t Vocabulary::word_of(const BinaryDescriptor& descriptor) const {
  return leaf_of(descriptor).word;
}

BagOfWords Vocabulary::bag_of(std::span<const BinaryDescriptor> descriptors) const {
  BagOfWords all;
  all.reserve(descriptors.size());
  for (const BinaryDescriptor& descriptor : descriptors) {
    const Node& leaf = leaf_of(descriptor);
    if (leaf.weight > 0.0F) all.push_back({leaf.word, leaf.weight});
  }
  std::ranges::sort(all, {}, &WordWeight::word);
  BagOfWords bag;
  float sum = 0.0F;
  for (const WordWeight& one : all) {
    if (bag.empty() || bag.back().word != one.word) bag.push_back({one.word, 0.0F});
    bag.back().weight += one.weight;  // term frequency times inverse document frequency
    sum += one.weight;
  }
  for (WordWeight& one : bag) one.weight /= sum;
  return bag;
}

}  // namespace sparsight
