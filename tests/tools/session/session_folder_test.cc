#include "tools/session/session_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// An empty folder that is the current one while a test runs.
class SessionFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) /
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    fs::create_directories(root_ / "sequences/04");
    before_ = fs::current_path();
    fs::current_path(root_);
  }
  void TearDown() override { fs::current_path(before_); }
  static void touch(const fs::path& file) { std::ofstream(file) << "x"; }

  fs::path root_;
  fs::path before_;
};

TEST_F(SessionFolder, TakesItsNameFromTheSourceHoweverThatIsWritten) {
  EXPECT_EQ(claim_session_folder({}, "sequences/04/", {}).value(), "session-04");
  EXPECT_EQ(claim_session_folder({}, "sequences/../sequences/04", 16).value(), "session-04-16rays");
  fs::current_path("sequences/04");
  EXPECT_EQ(source_name("."), "04");
}

TEST_F(SessionFolder, WithoutOutputNeverTouchesAnEarlierSession) {
  EXPECT_EQ(claim_session_folder({}, "sequences/04", {}).value(), "session-04");
  EXPECT_EQ(claim_session_folder({}, "sequences/04", {}).value(), "session-04-2");
  EXPECT_EQ(claim_session_folder({}, "sequences/04", {}).value(), "session-04-3");
  EXPECT_TRUE(fs::is_directory("session-04-3"));
}

TEST_F(SessionFolder, AcceptsNewEmptyAndEarlierSessionFolders) {
  EXPECT_TRUE(claim_session_folder("a/b/new", "sequences/04", {}));
  EXPECT_TRUE(claim_session_folder("a/b/new", "sequences/04", {}));
  touch("a/b/new/session.json");
  touch("a/b/new/trajectory.kitti");
  EXPECT_TRUE(claim_session_folder("a/b/new", "sequences/04", {}));
}

TEST_F(SessionFolder, RefusesAFolderWithOtherThings) {
  touch("sequences/04/calib.txt");
  const auto folder = claim_session_folder("sequences/04", "sequences/04", {});
  ASSERT_FALSE(folder);
  EXPECT_THAT(folder.error().message, HasSubstr("sequences/04: is not empty"));
}

TEST_F(SessionFolder, RefusesAFile) {
  touch("file");
  EXPECT_THAT(claim_session_folder("file", "sequences/04", {}).error().message,
              HasSubstr("file: is a file"));
  EXPECT_FALSE(claim_session_folder("file/below", "sequences/04", {}));
}

}  // namespace
}  // namespace sparsight
