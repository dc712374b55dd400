#include "slam/loop/vocabulary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <random>

#include "slam/loop/place_database.h"
#include "slam/loop/vocabulary_training.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

BinaryDescriptor filled(std::uint64_t bits) { return {bits, bits, bits, bits}; }

// Images that show noisy copies of some of 60 things.
std::vector<ImageDescriptors> made_images(std::size_t images, std::uint32_t seed) {
  std::mt19937_64 things(7);
  std::vector<BinaryDescriptor> thing(60);
  for (BinaryDescriptor& one : thing) {
    for (std::uint64_t& word : one) word = things();
  }
  std::mt19937_64 random(seed);
  std::vector<ImageDescriptors> result(images);
  for (std::size_t image = 0; image < images; ++image) {
    for (std::size_t i = 0; i < 40; ++i) {
      BinaryDescriptor seen = thing[(image * 3 + i % 10) % thing.size()];
      for (int flips = 0; flips < 12; ++flips) seen[random() % 4] ^= 1ULL << (random() % 64);
      result[image].push_back(seen);
    }
  }
  return result;
}

const Vocabulary& small_vocabulary() {
  static const Vocabulary kVocabulary =
      train_vocabulary(made_images(40, 1), {.branches = 6, .levels = 3});
  return kVocabulary;
}

std::string vocabulary_error(const std::string& text) {
  const auto vocabulary = Vocabulary::from_text(text, "voc.txt");
  return vocabulary ? "no error" : vocabulary.error().message;
}

std::string text_node(int parent, int leaf, int byte, const char* weight) {
  std::string line = std::to_string(parent) + " " + std::to_string(leaf);
  for (int i = 0; i < 32; ++i) line += " " + std::to_string(byte);
  return line + " " + weight + "\n";
}

// Two inner nodes with two words each; the second inner node's words stand before the first's.
const std::string kText = "2 2 0 0\n" + text_node(0, 0, 0, "0") + text_node(0, 0, 255, "0") +
                          text_node(2, 1, 254, "0.5") + text_node(2, 1, 127, "1.5") +
                          text_node(1, 1, 1, "2.5") + text_node(1, 1, 128, "3.5");

TEST(Vocabulary, ReadsTheTextOfOrbSlam) {
  const auto vocabulary = Vocabulary::from_text(kText, "voc.txt");
  ASSERT_TRUE(vocabulary) << vocabulary.error().message;
  EXPECT_EQ(vocabulary->words(), 4);
  EXPECT_EQ(vocabulary->branches(), 2);
  const BagOfWords bag = vocabulary->bag_of(std::vector{filled(0x0101010101010101)});
  ASSERT_EQ(bag.size(), 1);
  EXPECT_EQ(bag[0].weight, 1.0F);
  EXPECT_NE(vocabulary->word_of(filled(0xFEFEFEFEFEFEFEFE)),
            vocabulary->word_of(filled(0x7F7F7F7F7F7F7F7F)));
}

TEST(Vocabulary, BagsCountByTheWeightOfTheirWords) {
  const auto vocabulary = Vocabulary::from_text(kText, "voc.txt");
  ASSERT_TRUE(vocabulary);
  const BinaryDescriptor light = filled(0xFEFEFEFEFEFEFEFE);  // weight 0.5
  const BinaryDescriptor heavy = filled(0x0101010101010101);  // weight 2.5
  const BagOfWords bag = vocabulary->bag_of(std::vector{light, heavy, light});
  ASSERT_EQ(bag.size(), 2);
  EXPECT_LT(bag[0].word, bag[1].word);
  EXPECT_NEAR(std::max(bag[0].weight, bag[1].weight), 2.5 / 3.5, 1e-6);
  EXPECT_NEAR(bag[0].weight + bag[1].weight, 1.0, 1e-6);
}

TEST(Vocabulary, SimilarityIsOneOfTheSameAndNothingOfStrangers) {
  const BagOfWords a{{1, 0.25F}, {4, 0.75F}};
  const BagOfWords b{{2, 0.5F}, {4, 0.5F}};
  EXPECT_NEAR(similarity(a, a), 1.0, 1e-6);
  // 1 - (|0.25| + |0.5| + |0.75 - 0.5|) / 2
  EXPECT_NEAR(similarity(a, b), 0.5, 1e-6);
  EXPECT_EQ(similarity(a, {{7, 1.0F}}), 0.0);
  EXPECT_EQ(similarity(a, {}), 0.0);
}

TEST(Vocabulary, ErrorsOfTextNameTheLine) {
  EXPECT_THAT(vocabulary_error(""), HasSubstr("voc.txt:0: a vocabulary begins with"));
  EXPECT_THAT(vocabulary_error("10 6 0\n"), HasSubstr("voc.txt:1: a vocabulary begins with"));
  EXPECT_THAT(vocabulary_error("2 2 0 0\n"), HasSubstr("there are no nodes"));
  EXPECT_THAT(vocabulary_error("2 2 0 0\n0 1 1 2\n"), HasSubstr("voc.txt:2: a node is"));
  EXPECT_THAT(vocabulary_error("2 2 0 0\n" + text_node(0, 0, 256, "0")), HasSubstr("voc.txt:2"));
  EXPECT_THAT(vocabulary_error("2 2 0 0\n" + text_node(0, 0, 0, "nan")), HasSubstr("voc.txt:2"));
  EXPECT_THAT(vocabulary_error("2 2 0 0\n" + text_node(5, 1, 0, "1")),
              HasSubstr("voc.txt:2: there is no inner node 5"));
  EXPECT_THAT(vocabulary_error("2 2 0 0\n" + text_node(0, 1, 0, "1") + text_node(1, 1, 0, "1")),
              HasSubstr("voc.txt:3: there is no inner node 1"));
  const std::string child = text_node(0, 1, 0, "1");
  EXPECT_THAT(vocabulary_error("2 2 0 0\n" + child + child + child),
              HasSubstr("voc.txt:4: node 0 has more children"));
}

TEST(Vocabulary, BytesGiveTheSameVocabularyBack) {
  const std::string bytes = small_vocabulary().to_bytes();
  const auto again = Vocabulary::from_bytes(bytes, "voc.bin");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->to_bytes(), bytes);
  EXPECT_EQ(again->words(), small_vocabulary().words());
  for (const ImageDescriptors& image : made_images(3, 9)) {
    EXPECT_EQ(similarity(again->bag_of(image), small_vocabulary().bag_of(image)),
              similarity(again->bag_of(image), again->bag_of(image)));
  }
}

RC_GTEST_PROP(Vocabulary, DamagedBytesAreAnErrorOrAVocabulary, ()) {
  std::string bytes = small_vocabulary().to_bytes();
  if (*rc::gen::arbitrary<bool>()) {
    bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    RC_ASSERT(!Vocabulary::from_bytes(bytes, "voc.bin"));
    return;
  }
  const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
  bytes[at] = *rc::gen::arbitrary<char>();
  const auto vocabulary = Vocabulary::from_bytes(bytes, "voc.bin");
  if (vocabulary) RC_ASSERT(vocabulary->word_of(BinaryDescriptor{}) < vocabulary->words());
}

TEST(VocabularyTraining, GivesTheSameBytesForTheSameSeed) {
  const auto images = made_images(10, 3);
  const VocabularyTrainingConfig config{.branches = 5, .levels = 2, .seed = 4};
  EXPECT_EQ(train_vocabulary(images, config).to_bytes(),
            train_vocabulary(images, config).to_bytes());
  EXPECT_NE(train_vocabulary(images, {.branches = 5, .levels = 2, .seed = 5}).to_bytes(),
            train_vocabulary(images, config).to_bytes());
}

TEST(VocabularyTraining, KeepsToItsBranchesAndLevels) {
  const Vocabulary vocabulary = train_vocabulary(made_images(40, 1), {.branches = 6, .levels = 2});
  EXPECT_LE(vocabulary.words(), 36);
  EXPECT_GT(vocabulary.words(), 18);
  for (const Vocabulary::Node& node : vocabulary.nodes()) EXPECT_LE(node.children, 6);
}

TEST(VocabularyTraining, OfNothingAVocabularyWithoutWordsToTell) {
  const Vocabulary vocabulary = train_vocabulary({}, {});
  EXPECT_TRUE(vocabulary.bag_of(std::vector{filled(1)}).empty());
}

TEST(PlaceDatabase, FindsWhatLooksAlikeBeforeWhatDoesNot) {
  const Vocabulary& vocabulary = small_vocabulary();
  const auto images = made_images(20, 11);
  const auto seen_again = made_images(20, 12);
  PlaceDatabase database(vocabulary.words());
  for (const ImageDescriptors& image : images) database.add(vocabulary.bag_of(image));
  for (std::size_t i = 0; i < images.size(); ++i) {
    const BagOfWords view = vocabulary.bag_of(seen_again[i]);
    const auto matches = database.query(view, images.size(), 0.0, 3);
    ASSERT_FALSE(matches.empty());
    EXPECT_EQ(matches[0].place, i);
    EXPECT_NEAR(matches[0].similarity, similarity(view, vocabulary.bag_of(images[i])), 1e-5);
    EXPECT_GE(matches[0].similarity, matches.back().similarity);
  }
}

TEST(PlaceDatabase, KeepsRecentAndUnlikePlacesOut) {
  const Vocabulary& vocabulary = small_vocabulary();
  const BagOfWords bag = vocabulary.bag_of(made_images(1, 1)[0]);
  PlaceDatabase database(vocabulary.words());
  for (int i = 0; i < 5; ++i) database.add(bag);
  EXPECT_EQ(database.query(bag, 3, 0.5, 10).size(), 3);
  EXPECT_EQ(database.query(bag, 5, 0.5, 2).size(), 2);
  EXPECT_TRUE(database.query(bag, 0, 0.0, 10).empty());
  EXPECT_TRUE(database.query(bag, 5, 1.1, 10).empty());
}

}  // namespace
}  // namespace sparsight
