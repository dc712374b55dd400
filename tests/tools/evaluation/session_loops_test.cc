#include "tools/evaluation/session_loops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/session/atomic_file.h"
#include "tools/session/frame_figures.h"
#include "tools/session/session_summary.h"

namespace sparsight {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Status = FrameOutcome::Status;

// As a session writes them.
class SessionLoopsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    for (std::uint64_t i = 0; i < 6; ++i) {
      session_.frames.push_back({.sequence = 10 + i,
                                 .exposure = HostTime(std::chrono::milliseconds(100 * i)),
                                 .status = i < 3 ? Status::kTracked : Status::kLost,
                                 .keyframe = i != 1});
    }
    session_.submaps = {{.first_keyframe = 10, .part = 10}, {.first_keyframe = 14, .part = 10}};
    LoopClosure loop{.candidate = 10, .current = 14};
    loop.check.T_current_candidate =
        Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY());
    session_.loops = {loop, {.candidate = 99, .current = 14, .in_earlier_map = true}};
    write("session.json", session_json(session_, {}));
    std::string frames = frames_csv_header();
    for (const FrameFigures& frame : session_.frames) frames += frames_csv_line(frame);
    write("frames.csv", frames);
  }
  void write(const char* name, const std::string& text) const {
    ASSERT_TRUE(write_file(folder_ / name, text));
  }

  Session session_;
  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(SessionLoopsTest, AreReadAsTheSessionWroteThem) {
  const auto read = read_session_loops(folder_);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->loops.size(), 1);
  EXPECT_EQ(read->loops[0].frame, 14);
  EXPECT_EQ(read->loops[0].before, 10);
  EXPECT_TRUE(
      read->loops[0].T_frame_before.isApprox(session_.loops[0].check.T_current_candidate, 1e-12));
  EXPECT_EQ(read->with_earlier_map, 1);
  ASSERT_EQ(read->submaps.size(), 2);
  EXPECT_EQ(read->submaps[1].first_frame, 14);
  EXPECT_EQ(read->submaps[1].part, 10);
  EXPECT_EQ(read->exposures.size(), 6);
  EXPECT_EQ(read->exposures.at(13), session_.frames[3].exposure);
}

TEST_F(SessionLoopsTest, OfTheFramesThatWereLostOnlyTheOneThatBeganASubmapIsAKeyframe) {
  EXPECT_THAT(read_session_loops(folder_).value().keyframes, ElementsAre(10, 12, 14));
}

TEST_F(SessionLoopsTest, AFileThatIsNotASessionsIsNamed) {
  write("session.json", "{\"loops\": 3}");
  EXPECT_THAT(read_session_loops(folder_).error().message, HasSubstr("session.json: "));
  write("session.json", session_json(session_, {}));
  write("frames.csv", frames_csv_header() + "10,0.1,tracked\n");
  EXPECT_THAT(read_session_loops(folder_).error().message, HasSubstr("frames.csv:2: 3 fields"));
  std::filesystem::remove(folder_ / "frames.csv");
  EXPECT_THAT(read_session_loops(folder_).error().message, HasSubstr("frames.csv: no such file"));
}

}  // namespace
}  // namespace sparsight
