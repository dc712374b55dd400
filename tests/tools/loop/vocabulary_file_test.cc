#include "tools/loop/vocabulary_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "slam/loop/orb_features.h"
#include "tests/build_paths.h"
#include "tools/evaluation/text_file.h"
#include "tools/loop/training_images.h"
#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kShipped = testing::source_dir() / "config/vocabulary.bin";

TEST(VocabularyFile, TheProgramCarriesTheShippedOne) {
  const auto shipped = load_vocabulary(kShipped);
  ASSERT_TRUE(shipped) << shipped.error().message;
  EXPECT_EQ(built_in_vocabulary()->to_bytes(), read_text_file(kShipped).value());
  EXPECT_EQ(shipped->to_bytes(), read_text_file(kShipped).value());
  EXPECT_GT(shipped->words(), 5000);
  EXPECT_LT(fs::file_size(kShipped), 5'000'000);
}

TEST(VocabularyFile, IsToldByItsFirstBytes) {
  EXPECT_THAT(parse_vocabulary("SPVOC", "v").error().message, HasSubstr("v: byte 0"));
  EXPECT_THAT(parse_vocabulary("10 6 0 x", "v").error().message, HasSubstr("v:1: "));
  EXPECT_THAT(load_vocabulary("/nowhere/v").error().message, HasSubstr("/nowhere/v: no such file"));
}

TEST(TrainingImages, AFolderIsReadInTheOrderOfItsPaths) {
  const fs::path folder = fs::path(::testing::TempDir()) / "training_images";
  fs::remove_all(folder);
  EXPECT_THAT(images_in_folder(folder).error().message, HasSubstr("give a folder"));
  fs::create_directories(folder / "b");
  EXPECT_THAT(images_in_folder(folder).error().message, HasSubstr("holds no PNG or JPEG file"));
  ASSERT_TRUE(write_file(folder / "b" / "bad.png", "no image"));
  EXPECT_THAT(images_in_folder(folder).error().message, HasSubstr("bad.png: cannot be read"));
}

TEST(TrainingImages, OfASceneAreWhatItsCameraSees) {
  const auto images =
      rendered_images({.scene = SimulatedScene::kHall, .duration_s = 1.0, .light_detail = 0.2});
  ASSERT_FALSE(images.empty());
  EXPECT_EQ(images[0].width, 400);
  EXPECT_EQ(images[0].pixels.size(), 400 * 300);
  EXPECT_GT(orb_features(images[0], {}).pixels.size(), 200);
}

}  // namespace
}  // namespace sparsight
