#include "tools/benchmark/kitti_sequences.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/benchmark/sample_benchmark.h"

namespace sparsight {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(KittiSequences, FindsWhatCanBeReplayedInTheOrderOfTheNames) {
  const auto root = testing::fresh_folder();
  testing::put_sequence(root, "11", 3, 0);
  testing::put_sequence(root, "04", 2, 5);
  const auto sequences = find_kitti_sequences(root, {});
  ASSERT_TRUE(sequences) << sequences.error().message;
  ASSERT_EQ(sequences->found.size(), 2U);
  EXPECT_EQ(sequences->found[0].name, "04");
  EXPECT_EQ(sequences->found[0].images, 2U);
  EXPECT_EQ(sequences->found[0].truth, root / "poses/04.txt");
  EXPECT_EQ(sequences->found[1].name, "11");
  EXPECT_FALSE(sequences->found[1].truth.has_value());
}

TEST(KittiSequences, TakesTheFolderAsTheArchivesUnpackIt) {
  const auto root = testing::fresh_folder();
  testing::put_sequence(root / "dataset", "00", 1, 1);
  const auto sequences = find_kitti_sequences(root, {});
  ASSERT_TRUE(sequences) << sequences.error().message;
  EXPECT_EQ(sequences->found.at(0).folder, root / "dataset/sequences/00");
}

TEST(KittiSequences, PassesOverSequencesWithoutScansAndSaysSo) {
  const auto root = testing::fresh_folder();
  testing::put_sequence(root, "00", 1, 1);
  testing::put_sequence(root, "01", 1, 1);
  std::filesystem::remove(root / "sequences/01/velodyne");
  std::filesystem::create_directories(root / "sequences/02/velodyne");
  const auto sequences = find_kitti_sequences(root, {});
  ASSERT_TRUE(sequences);
  EXPECT_EQ(sequences->found.size(), 1U);
  EXPECT_THAT(sequences->notes,
              ElementsAre(HasSubstr("01: no folder velodyne"), HasSubstr("02: no PNG images")));
}

TEST(KittiSequences, GivesColourCamerasNoGroundTruthAsItIsOfCamera0) {
  const auto root = testing::fresh_folder();
  testing::put_sequence(root, "00", 1, 1);
  std::filesystem::rename(root / "sequences/00/image_0", root / "sequences/00/image_2");
  const auto sequences = find_kitti_sequences(root, {});
  ASSERT_TRUE(sequences) << sequences.error().message;
  EXPECT_EQ(sequences->found.at(0).images, 1U);
  EXPECT_FALSE(sequences->found.at(0).truth.has_value());
}

TEST(KittiSequences, RefusesToLeaveOutWhatWasAskedFor) {
  const auto root = testing::fresh_folder();
  testing::put_sequence(root, "00", 1, 1);
  EXPECT_EQ(find_kitti_sequences(root, {"00"})->found.size(), 1U);
  const auto sequences = find_kitti_sequences(root, {"00", "7"});
  ASSERT_FALSE(sequences);
  EXPECT_THAT(sequences.error().message, HasSubstr("sequences/7: no such folder"));
}

TEST(KittiSequences, SaysWhichFolderItNeeds) {
  const auto root = testing::fresh_folder();
  EXPECT_THAT(find_kitti_sequences(root, {}).error().message,
              HasSubstr("holds no folder sequences"));
  std::filesystem::create_directories(root / "sequences/00");
  EXPECT_THAT(find_kitti_sequences(root, {}).error().message, HasSubstr("no sequence has both"));
}

}  // namespace
}  // namespace sparsight
