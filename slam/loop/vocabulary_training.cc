#include "slam/loop/vocabulary_training.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace sparsight {
namespace {

using Members = std::vector<const BinaryDescriptor*>;

// SplitMix64 (Steele, Lea and Flood 2014): the same draws on every system.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t bound) {
    state_ += 0x9E3779B97F4A7C15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return (z ^ (z >> 31)) % bound;
  }

 private:
  std::uint64_t state_;
};

BinaryDescriptor majority(const Members& members) {
  std::array<int, 256> set_bits{};
  for (const BinaryDescriptor* member : members) {
    for (std::size_t bit = 0; bit < set_bits.size(); ++bit) {
      set_bits[bit] += static_cast<int>(((*member)[bit / 64] >> (bit % 64)) & 1U);
    }
  }
  BinaryDescriptor centre{};
  for (std::size_t bit = 0; bit < set_bits.size(); ++bit) {
    const bool set = 2 * static_cast<std::size_t>(set_bits[bit]) > members.size();
    centre[bit / 64] |= std::uint64_t{set} << (bit % 64);
  }
  return centre;
}

std::size_t nearest(const std::vector<BinaryDescriptor>& centres, const BinaryDescriptor& member) {
  const auto distance = [&](const BinaryDescriptor& c) { return hamming_distance(c, member); };
  return static_cast<std::size_t>(std::ranges::min_element(centres, {}, distance) -
                                  centres.begin());
}

// Each next seed is drawn by the square of its distance from those there are.
std::vector<BinaryDescriptor> seeds_of(const Members& members, std::size_t wanted, Draws& draws) {
  std::vector<BinaryDescriptor> seeds{*members[draws.below(members.size())]};
  std::vector<std::uint64_t> distance2(members.size(), std::numeric_limits<std::uint64_t>::max());
  while (seeds.size() < wanted) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const auto distance = static_cast<std::uint64_t>(hamming_distance(*members[i], seeds.back()));
      distance2[i] = std::min(distance2[i], distance * distance);
      sum += distance2[i];
    }
    if (sum == 0) break;  // as many seeds as there are different descriptors
    std::uint64_t drawn = draws.below(sum);
    std::size_t chosen = 0;
    while (drawn >= distance2[chosen]) drawn -= distance2[chosen++];
    seeds.push_back(*members[chosen]);
  }
  return seeds;
}

struct Cluster {
  BinaryDescriptor centre{};
  Members members;
};

std::vector<Cluster> clusters_of(const Members& members, const VocabularyTrainingConfig& config,
                                 Draws& draws) {
  std::vector<BinaryDescriptor> centres =
      seeds_of(members, static_cast<std::size_t>(config.branches), draws);
  std::vector<std::size_t> belongs(members.size(), centres.size());
  std::vector<Cluster> clusters;
  for (int iteration = 0; iteration < config.max_iterations; ++iteration) {
    bool moved = false;
    clusters.assign(centres.size(), {});
    for (std::size_t i = 0; i < members.size(); ++i) {
      const std::size_t cluster = nearest(centres, *members[i]);
      moved = moved || cluster != belongs[i];
      belongs[i] = cluster;
      clusters[cluster].members.push_back(members[i]);
    }
    for (std::size_t c = 0; c < centres.size(); ++c) {
      clusters[c].centre = centres[c];
      if (moved && !clusters[c].members.empty()) centres[c] = majority(clusters[c].members);
    }
    if (!moved) break;
  }
  std::erase_if(clusters, [](const Cluster& cluster) { return cluster.members.empty(); });
  return clusters;
}

// log(N / n) of each word; a word that no image shows says nothing.
void weigh(std::vector<Vocabulary::Node>& nodes, const Vocabulary& tree,
           std::span<const ImageDescriptors> images) {
  std::vector<std::size_t> shown_in(tree.words(), 0);
  for (const ImageDescriptors& image : images) {
    std::set<std::uint32_t> words;
    for (const BinaryDescriptor& descriptor : image) words.insert(tree.word_of(descriptor));
    for (const std::uint32_t word : words) ++shown_in[word];
  }
  std::size_t word = 0;
  for (Vocabulary::Node& node : nodes) {
    if (node.children > 0) continue;
    const auto shown = static_cast<double>(shown_in[word++]);
    if (shown > 0) {
      node.weight = static_cast<float>(std::log(static_cast<double>(images.size()) / shown));
    }
  }
}

}  // namespace

Vocabulary train_vocabulary(std::span<const ImageDescriptors> images,
                            const VocabularyTrainingConfig& config) {
  Draws draws(config.seed);
  std::vector<Vocabulary::Node> nodes(1);
  std::vector<Members> members_of(1);
  for (const ImageDescriptors& image : images) {
    for (const BinaryDescriptor& descriptor : image) members_of[0].push_back(&descriptor);
  }
  std::size_t begin = 0;
  for (int level = 0; level < config.levels; ++level) {
    const std::size_t end = nodes.size();
    for (std::size_t at = begin; at < end; ++at) {
      const Members members = std::move(members_of[at]);
      if (members.size() < 2) continue;
      nodes[at].first_child = static_cast<std::uint32_t>(nodes.size());
      for (Cluster& cluster : clusters_of(members, config, draws)) {
        nodes.push_back({.descriptor = cluster.centre});
        members_of.push_back(std::move(cluster.members));
        ++nodes[at].children;
      }
    }
    begin = end;
  }
  weigh(nodes, Vocabulary(config.branches, config.levels, nodes), images);
  return {config.branches, config.levels, std::move(nodes)};
}

}  // namespace sparsight
