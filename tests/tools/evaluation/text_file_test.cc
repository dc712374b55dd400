#include "tools/evaluation/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sparsight {
namespace {

using ::testing::HasSubstr;

std::filesystem::path fresh_folder(const char* name) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(TextFile, ReadsBackWhatWasWritten) {
  const auto folder = fresh_folder("text_file_round_trip");
  const std::string text("two\nlines\0and a zero", 20);
  ASSERT_TRUE(write_text_file(folder / "a", text));
  EXPECT_EQ(read_text_file(folder / "a").value(), text);
  ASSERT_TRUE(write_text_file(folder / "a", ""));
  EXPECT_EQ(read_text_file(folder / "a").value(), "");
}

TEST(TextFile, LeavesNothingHalfWhenItCannotBeWritten) {
  const auto folder = fresh_folder("text_file_refused");
  std::filesystem::create_directories(folder / "a/in the way");
  const auto written = write_text_file(folder / "a", "text");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.partial"));
  EXPECT_FALSE(write_text_file(folder / "no such folder/a", "text"));
}

}  // namespace
}  // namespace sparsight
