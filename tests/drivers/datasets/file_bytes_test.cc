#include "drivers/datasets/file_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/datasets/small_dataset.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;
using testing::write_file;

TEST(FileBytes, AreTheWholeFile) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  write_file(folder.path() / "f", bytes);
  EXPECT_EQ(*read_file_bytes(folder.path() / "f"), bytes);
  write_file(folder.path() / "empty", "");
  EXPECT_EQ(*read_file_bytes(folder.path() / "empty"), "");
}

TEST(FileBytes, OfFoldersDevicesAndNothingAreRefused) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_file_bytes(folder.path()).error().code, ErrorCode::kUnreadable);
  EXPECT_EQ(read_file_bytes("/dev/zero").error().code, ErrorCode::kUnreadable);
  EXPECT_EQ(read_file_bytes(folder.path() / "f").error().code, ErrorCode::kNotFound);
  EXPECT_THAT(read_file_bytes(folder.path() / "f").error().message, HasSubstr("f: no such file"));
  std::filesystem::create_symlink("loop", folder.path() / "loop");
  EXPECT_FALSE(read_file_bytes(folder.path() / "loop"));
}

TEST(NumberedFiles, AreFoundByNumberWhateverTheirPadding) {
  const TemporaryFolder folder;
  for (const char* name : {"000000.png", "7.png", "0000000012.png", "x.png", "1.txt", "-2.png",
                           "3.5.png", "99999999999999999999999.png"}) {
    write_file(folder.path() / name, "");
  }
  std::vector<std::uint64_t> numbers;
  for (const auto& [number, file] : list_numbered_files(folder.path(), {".png"})) {
    numbers.push_back(number);
  }
  EXPECT_THAT(numbers, ::testing::ElementsAre(0, 7, 12));
}

TEST(NumberedFiles, PreferTheFirstExtension) {
  const TemporaryFolder folder;
  write_file(folder.path() / "1.jpg", "");
  write_file(folder.path() / "1.png", "");
  write_file(folder.path() / "2.jpg", "");
  const auto files = list_numbered_files(folder.path(), {".png", ".jpg"});
  EXPECT_EQ(files.at(1).filename(), "1.png");
  EXPECT_EQ(files.at(2).filename(), "2.jpg");
}

TEST(NumberedFiles, OfAFolderThatIsNotThereAreNone) {
  EXPECT_TRUE(list_numbered_files("/no/such/folder", {".png"}).empty());
}

}  // namespace
}  // namespace sparsight
