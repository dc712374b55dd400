#include "tools/map/paged_keyframes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/recording/made_recording.h"
#include "tests/tools/map/made_keyframe.h"

namespace sparsight {
namespace {

using testing::made_cloud;
using testing::MadeDisk;
using testing::MadeOutput;
using testing::patchwork;
using testing::TemporaryFolder;

KeyframeBulk bulk_of(std::uint32_t number) {
  return {.image = patchwork(40, 30, number), .cloud_camera = made_cloud(20 + number, number)};
}

TEST(PagedKeyframes, GivesBackWhatWasPutInInAnyOrder) {
  const TemporaryFolder folder;
  PagedKeyframes keyframes;
  keyframes.write_to(KeyframeFile::create(folder.path() / "keyframes").value());
  for (std::uint32_t i = 0; i < 30; ++i) EXPECT_EQ(keyframes.put(bulk_of(i)), i);
  for (const std::uint32_t i : {29U, 0U, 17U, 17U, 3U}) {
    const auto bulk = keyframes.get(i);
    ASSERT_TRUE(bulk) << keyframes.message();
    EXPECT_EQ(bulk->image.pixels, bulk_of(i).image.pixels);
    EXPECT_EQ(bulk->cloud_camera.size(), 20 + i);
  }
  // While it is read, it still grows.
  keyframes.put(bulk_of(30));
  EXPECT_EQ(keyframes.get(30)->cloud_camera.size(), 50U);
  EXPECT_FALSE(keyframes.get(31));
  EXPECT_EQ(keyframes.not_kept() + keyframes.damaged(), 0U);
}

TEST(PagedKeyframes, GoOnFromFilesOfEarlierSessions) {
  const TemporaryFolder folder;
  PagedKeyframes first;
  first.write_to(KeyframeFile::create(folder.path() / "1").value());
  for (std::uint32_t i = 0; i < 3; ++i) first.put(bulk_of(i));
  PagedKeyframes second;
  std::vector<KeyframeFile> files;
  files.push_back(KeyframeFile::open(folder.path() / "1").value());
  second.take_over(std::move(files), first.places());
  second.write_to(KeyframeFile::create(folder.path() / "2").value());
  EXPECT_EQ(second.put(bulk_of(3)), 3U);
  for (std::uint32_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(second.get(i)) << second.message();
    EXPECT_EQ(second.get(i)->cloud_camera.size(), 20 + i);
  }
}

TEST(PagedKeyframes, ADamagedOneIsLeftOutAndCountedAndTheOthersAreThere) {
  const TemporaryFolder folder;
  PagedKeyframes keyframes;
  keyframes.write_to(KeyframeFile::create(folder.path() / "keyframes").value());
  for (std::uint32_t i = 0; i < 3; ++i) keyframes.put(bulk_of(i));
  {
    std::fstream file(folder.path() / "keyframes", std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(keyframes.places()[1].record->offset + 100));
    file.put('\x7e');
  }
  EXPECT_TRUE(keyframes.get(0));
  EXPECT_FALSE(keyframes.get(1));
  EXPECT_TRUE(keyframes.get(2));
  EXPECT_EQ(keyframes.damaged(), 1U);
  EXPECT_THAT(keyframes.message(), ::testing::HasSubstr("checksum"));
}

TEST(PagedKeyframes, AFullDiskCostsKeyframesButNotThoseBefore) {
  MadeDisk disk;
  const std::size_t record =
      KeyframeFile("", std::make_unique<MadeOutput>(disk), 1 << 20).append(bulk_of(0))->bytes;
  disk.bytes.clear();
  disk.capacity = 2 * record + record / 2;
  PagedKeyframes keyframes;
  keyframes.write_to(KeyframeFile("made", std::make_unique<MadeOutput>(disk), 1 << 20));
  for (int i = 0; i < 4; ++i) keyframes.put(bulk_of(0));
  EXPECT_EQ(keyframes.not_kept(), 2U);
  EXPECT_EQ(disk.bytes.size(), 2 * record) << "half a record stayed";
  EXPECT_THAT(keyframes.message(), ::testing::HasSubstr("No space left"));
  EXPECT_FALSE(keyframes.get(3));
  disk.capacity = UINT64_MAX;  // someone made room
  keyframes.put(bulk_of(0));
  EXPECT_EQ(keyframes.not_kept(), 2U);
  EXPECT_EQ(keyframes.places()[4].record->offset, 2 * record);
}

TEST(PagedKeyframes, TheFileNeverGrowsBeyondItsBound) {
  const TemporaryFolder folder;
  PagedKeyframes keyframes;
  keyframes.write_to(KeyframeFile::create(folder.path() / "keyframes", 5000).value());
  for (std::uint32_t i = 0; i < 10; ++i) keyframes.put(bulk_of(i));
  EXPECT_LE(std::filesystem::file_size(folder.path() / "keyframes"), 5000U);
  EXPECT_EQ(keyframes.not_kept(), 7U);
  EXPECT_TRUE(keyframes.get(1));
}

TEST(PagedKeyframes, AFileThatWasCutOffGivesWhatIsWhole) {
  const TemporaryFolder folder;
  PagedKeyframes written;
  written.write_to(KeyframeFile::create(folder.path() / "keyframes").value());
  for (std::uint32_t i = 0; i < 4; ++i) written.put(bulk_of(i));
  testing::truncate_file(folder.path() / "keyframes", 0.6);
  PagedKeyframes read;
  std::vector<KeyframeFile> files;
  files.push_back(KeyframeFile::open(folder.path() / "keyframes").value());
  read.take_over(std::move(files), written.places());
  EXPECT_TRUE(read.get(0));
  EXPECT_TRUE(read.get(1));
  EXPECT_FALSE(read.get(3));
  EXPECT_THAT(read.message(), ::testing::HasSubstr("cut off"));
}

}  // namespace
}  // namespace sparsight
