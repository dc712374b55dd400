#include "tools/evaluation/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

TEST(TextFile, ReadsEveryByte) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "text_file_every_byte";
  const std::string text("two\r\nlines\0and a zero", 22);
  ASSERT_TRUE(write_file(file, text));
  EXPECT_EQ(read_text_file(file).value(), text);
  ASSERT_TRUE(write_file(file, ""));
  EXPECT_EQ(read_text_file(file).value(), "");
}

TEST(TextFile, SaysWhatIsWrongWithWhatItCannotRead) {
  const auto missing = read_text_file("/nowhere/a.txt");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(missing.error().message, "/nowhere/a.txt: no such file");
  const auto folder = read_text_file(::testing::TempDir());
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message, HasSubstr("is a folder"));
}

}  // namespace
}  // namespace sparsight
