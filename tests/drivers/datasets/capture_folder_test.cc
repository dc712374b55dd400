#include "drivers/datasets/capture_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/datasets/made_capture_folder.h"

namespace sparsight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::MadeCaptureFolder;
using testing::TemporaryFolder;

std::string index_error(const MadeCaptureFolder& made) {
  const auto index = index_capture_folder(made.folder);
  return index ? "indexed" : index.error().message;
}

TEST(CaptureFolder, PutsImagesInTheOrderOfTheirNumbers) {
  const MadeCaptureFolder made;
  const auto index = index_capture_folder(made.folder);
  ASSERT_TRUE(index) << index.error().message;
  ASSERT_EQ(index->images.size(), 10U);
  EXPECT_EQ(index->images[1].filename(), "frame_2.png");
  EXPECT_EQ(index->images[9].filename(), "frame_10.png") << "not after frame_1";
  ASSERT_EQ(index->exposures.size(), 10U);
  EXPECT_NEAR(to_seconds(index->exposures[3] - index->exposures[0]), 0.12, 1e-6);
  EXPECT_EQ(index->clock, CaptureClock::kCapture);
}

TEST(CaptureFolder, IsKnownEvenWhenPartsAreMissing) {
  EXPECT_FALSE(is_capture_folder("/no/such/folder"));
  EXPECT_FALSE(is_capture_folder(TemporaryFolder().path()));
  for (const char* part : {"lidar.pcap", "rig.toml", "times.txt"}) {
    const MadeCaptureFolder made;
    std::filesystem::remove(made.folder / part);
    EXPECT_TRUE(is_capture_folder(made.folder));
    EXPECT_THAT(index_error(made), AllOf(HasSubstr(made.folder.string()),
                                         HasSubstr("a capture folder holds lidar.pcap")))
        << part;
  }
  const MadeCaptureFolder made;
  std::filesystem::remove_all(made.folder / "images");
  EXPECT_THAT(index_error(made), HasSubstr("images: no images (*.png, *.jpg)"));
}

TEST(CaptureFolder, TakesAnyOneCaptureAndOfSeveralTheLidars) {
  const MadeCaptureFolder made;
  const auto capture = made.folder / "lidar.pcap";
  std::filesystem::copy(capture, made.folder / "other.pcapng");
  EXPECT_EQ(index_capture_folder(made.folder)->capture, capture);
  std::filesystem::rename(capture, made.folder / "walk.PCAP");
  EXPECT_THAT(index_error(made), HasSubstr("2 captures; name the LiDAR's lidar.pcap"));
  std::filesystem::remove(made.folder / "other.pcapng");
  EXPECT_EQ(index_error(made), "indexed");
}

TEST(CaptureFolder, RefusesCountsThatDiffer) {
  const MadeCaptureFolder made;
  std::filesystem::remove(made.image(4));
  EXPECT_THAT(index_error(made), AllOf(HasSubstr("times.txt: 10 times"), HasSubstr("9 images")));
}

TEST(CaptureFolder, RefusesTimesThatAreNoneOrDoNotAscendWithTheirLine) {
  const MadeCaptureFolder made;
  testing::write_file(made.folder / "times.txt", "# seconds\n1700000000.5\n1700000000.5\n");
  EXPECT_THAT(index_error(made), HasSubstr("times.txt:3: time 1700000000.5"));
  testing::write_file(made.folder / "times.txt", "# seconds\n1700000000.1\nsoon\n");
  EXPECT_THAT(index_error(made), HasSubstr("times.txt:3: \"soon\" is not a time in seconds"));
}

TEST(CaptureFolder, ReadsWhoseClockTheTimesAreOf) {
  const MadeCaptureFolder made;
  made.write_times(0.05, "# camera times\n# clock: lidar\n");
  EXPECT_EQ(index_capture_folder(made.folder)->clock, CaptureClock::kLidar);
  made.write_times(0.05, "# clock: capture\n");
  EXPECT_EQ(index_capture_folder(made.folder)->clock, CaptureClock::kCapture);
  made.write_times(0.05, "# clock: gps\n");
  EXPECT_THAT(index_error(made), HasSubstr("times.txt:1: clock must be"));
  testing::write_file(made.folder / "times.txt", "#");
  EXPECT_THAT(index_error(made), HasSubstr("times.txt: 0 times"));
}

}  // namespace
}  // namespace sparsight
