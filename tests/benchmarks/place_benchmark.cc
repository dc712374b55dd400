#include <benchmark/benchmark.h>

#include <random>

#include "slam/loop/orb_features.h"
#include "slam/loop/place_database.h"
#include "tools/loop/vocabulary_file.h"

namespace sparsight {
namespace {

// Descriptors near words of the vocabulary that ships: places show many of the same words.
std::vector<BinaryDescriptor> made_view(std::mt19937_64& random, const Vocabulary& vocabulary) {
  std::vector<BinaryDescriptor> view;
  while (view.size() < 800) {
    BinaryDescriptor one = vocabulary.nodes()[random() % vocabulary.nodes().size()].descriptor;
    for (int flips = 0; flips < 10; ++flips) one[random() % 4] ^= 1ULL << (random() % 64);
    view.push_back(one);
  }
  return view;
}

// Words of a view, and the places most like it.
void query_place(benchmark::State& state) {
  const Vocabulary& vocabulary = *built_in_vocabulary();
  std::mt19937_64 random(1);
  PlaceDatabase database(vocabulary.words());
  for (int64_t place = 0; place < state.range(0); ++place) {
    database.add(vocabulary.bag_of(made_view(random, vocabulary)));
  }
  const std::vector<BinaryDescriptor> view = made_view(random, vocabulary);
  for (auto _ : state) {
    const BagOfWords bag = vocabulary.bag_of(view);
    benchmark::DoNotOptimize(database.query(bag, database.size(), 0.01, 10));
  }
}
BENCHMARK(query_place)->ArgName("places")->Arg(5000)->Unit(benchmark::kMillisecond);

// Of a keyframe's image, 800 x 600 halved once.
void find_orb_features(benchmark::State& state) {
  std::mt19937 random(1);
  GreyImage image{.width = 400, .height = 300};
  for (int i = 0; i < 400 * 300; ++i) {
    const int block = ((i % 400) / 9) * 31 + (i / 400 / 7) * 17;
    image.pixels.push_back(static_cast<std::uint8_t>(60 + (block * block) % 140 + random() % 8));
  }
  for (auto _ : state) benchmark::DoNotOptimize(orb_features(image, {}));
}
BENCHMARK(find_orb_features)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sparsight
