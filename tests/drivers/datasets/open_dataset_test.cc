#include "drivers/datasets/open_dataset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/datasets/small_dataset.h"

namespace sparsight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::SmallDrive;
using testing::SmallSequence;
using testing::TemporaryFolder;

std::string open_error(const std::filesystem::path& folder, const DatasetOptions& options = {}) {
  const auto source = open_dataset(folder, options);
  return source ? "opened" : source.error().message;
}

TEST(OpenDataset, RecognisesBothLayoutsWithATrailingSlashOrWithout) {
  const SmallSequence sequence;
  const SmallDrive drive;
  for (const std::filesystem::path& folder : {sequence.folder, drive.folder}) {
    EXPECT_EQ(open_error(folder), "opened");
    EXPECT_EQ(open_error(folder.string() + "/"), "opened");
  }
}

TEST(OpenDataset, WorksFromInsideTheFolder) {
  const SmallDrive drive;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(drive.folder);
  EXPECT_EQ(open_error("."), "opened");
  std::filesystem::current_path(before);
}

TEST(OpenDataset, SaysWhatItLookedFor) {
  const TemporaryFolder empty;
  EXPECT_THAT(open_error(empty.path()),
              AllOf(HasSubstr(empty.path().string()), HasSubstr("calib.txt"), HasSubstr("image_N"),
                    HasSubstr("velodyne_points")));
}

TEST(OpenDataset, NamesTheDataSetsBelowAFolderThatIsNone) {
  const SmallSequence sequence;
  EXPECT_THAT(open_error(sequence.folder.parent_path()), HasSubstr(sequence.folder.string()));
  const SmallDrive drive;
  EXPECT_THAT(open_error(drive.day.parent_path()), HasSubstr(drive.folder.string()));
}

TEST(OpenDataset, RefusesWhatIsNotThereAndWhatIsAFile) {
  EXPECT_THAT(open_error("/no/such/folder"), HasSubstr("/no/such/folder: no such folder"));
  const SmallSequence sequence;
  EXPECT_THAT(open_error(sequence.folder / "calib.txt"), HasSubstr("a data set is a folder"));
}

TEST(OpenDataset, RefusesFewerThanOneRay) {
  const SmallSequence sequence;
  EXPECT_THAT(open_error(sequence.folder, {.rays = 0}), HasSubstr("rays: 0"));
  EXPECT_THAT(open_error(sequence.folder, {.rays = -5}), HasSubstr("rays: -5"));
}

}  // namespace
}  // namespace sparsight
