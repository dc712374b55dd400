#include "tools/session/tracking_news.h"

#include <gtest/gtest.h>

#include "tools/session/session_summary.h"

namespace sparsight {
namespace {

using Status = FrameOutcome::Status;

FrameRecord frame(std::uint64_t sequence, Status status, std::uint32_t submap = 0) {
  FrameRecord record{.sequence = sequence};
  record.outcome.status = status;
  record.outcome.submap = submap;
  return record;
}

TEST(TrackingNews, TellsOfALossOnceAndOfItsEnd) {
  TrackingNews news;
  EXPECT_FALSE(news.of(frame(1, Status::kTracked)));
  EXPECT_FALSE(news.of(frame(2, Status::kPredicted)));
  EXPECT_EQ(news.of(frame(3, Status::kLost)),
            "frame 3: lost: where the camera is is not known from here on");
  EXPECT_FALSE(news.of(frame(4, Status::kLost)));
  EXPECT_EQ(news.of(frame(5, Status::kTracked)), "frame 5: found again, beside the last keyframe");
  EXPECT_TRUE(news.of(frame(6, Status::kLost)));
  const auto goes_on = news.of(frame(7, Status::kTracked, 1));
  ASSERT_TRUE(goes_on);
  EXPECT_NE(goes_on->find("frame 7: tracking goes on in sub-map 1"), std::string::npos);
  EXPECT_FALSE(news.of(frame(8, Status::kTracked, 1)));
}

TEST(Gaps, AreFramesInARowWithoutAPose) {
  std::vector<TrajectoryPose> path(10);
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].sequence = 100 + i;
    path[i].exposure = HostTime(std::chrono::milliseconds(100) * static_cast<long>(i));
    path[i].known = i != 3 && i != 4 && i < 8;
  }
  const std::vector<Gap> gaps = gaps_of(path);
  ASSERT_EQ(gaps.size(), 2);
  EXPECT_EQ(gaps[0].first, 103);
  EXPECT_EQ(gaps[0].last, 104);
  EXPECT_NEAR(gaps[0].seconds, 0.3, 1e-9);
  EXPECT_EQ(gaps[1].last, 109) << "to the end";
  EXPECT_TRUE(gaps_of({}).empty());
}

}  // namespace
}  // namespace sparsight
