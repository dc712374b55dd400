#include "drivers/datasets/velodyne_scan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <limits>

namespace sparsight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::string bytes_of(const std::vector<std::array<float, 4>>& points) {
  std::string bytes(points.size() * 16, '\0');
  if (!points.empty()) std::memcpy(bytes.data(), points.data(), bytes.size());
  return bytes;
}

TEST(VelodyneScan, KeepsPointsInTheOrderOfStorage) {
  const auto scan = parse_velodyne_scan(bytes_of({{1, 2, 3, 0.5F}, {-4, 5, -6, 0.25F}}), "f");
  ASSERT_TRUE(scan);
  ASSERT_THAT(scan->returns, SizeIs(2));
  EXPECT_EQ(scan->returns[0].p_lidar, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(scan->returns[1].p_lidar, Eigen::Vector3f(-4, 5, -6));
  EXPECT_EQ(scan->returns[1].intensity, 0.25F);
  EXPECT_EQ(scan->refused, 0U);
}

TEST(VelodyneScan, ReadsTheBytesOfTheFormat) {
  // 1.0F, -2.0F, 0.5F, 0.0F, little-endian, by hand from IEEE 754.
  const std::string bytes("\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x00\x00\x3f\x00\x00\x00\x00", 16);
  EXPECT_EQ(parse_velodyne_scan(bytes, "f")->returns.at(0).p_lidar, Eigen::Vector3f(1, -2, 0.5F));
}

TEST(VelodyneScan, CountsWhatIsNoPointAndDropsFiringsWithoutReturn) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto scan = parse_velodyne_scan(bytes_of({{1, 2, 3, 0},
                                                  {kNan, 2, 3, 0},
                                                  {1, -kInfinity, 3, 0},
                                                  {1, 2, 3e38F, 0},
                                                  {0, 0, 0, 0},
                                                  {-0.0F, 0, 0, 1}}),
                                        "f");
  ASSERT_TRUE(scan);
  EXPECT_THAT(scan->returns, SizeIs(1));
  EXPECT_EQ(scan->refused, 3U);
}

TEST(VelodyneScan, KeepsAPointWhoseIntensityIsNoNumber) {
  const auto scan =
      parse_velodyne_scan(bytes_of({{1, 2, 3, std::numeric_limits<float>::quiet_NaN()}}), "f");
  ASSERT_THAT(scan->returns, SizeIs(1));
  EXPECT_EQ(scan->returns[0].intensity, 0.0F);
}

TEST(VelodyneScan, OfNoBytesHasNoPoints) {
  EXPECT_THAT(parse_velodyne_scan("", "f")->returns, IsEmpty());
}

TEST(VelodyneScan, RefusesAPartOfAPoint) {
  for (const std::size_t size : {1U, 15U, 17U, 1000U * 16U + 8U}) {
    const auto scan = parse_velodyne_scan(std::string(size, 'x'), "a.bin");
    ASSERT_FALSE(scan);
    EXPECT_EQ(scan.error().code, ErrorCode::kWrongSize);
    EXPECT_THAT(scan.error().message, AllOf(HasSubstr("a.bin"), HasSubstr(std::to_string(size))));
  }
}

TEST(VelodyneText, HasOnePointALine) {
  const auto scan = parse_velodyne_text("1 2 3 0.5\n\n-4.25 5e0 -6 0\r\n0 0 0 0\nnan 1 1 1\n", "f");
  ASSERT_TRUE(scan);
  ASSERT_THAT(scan->returns, SizeIs(2));
  EXPECT_EQ(scan->returns[1].p_lidar, Eigen::Vector3f(-4.25F, 5, -6));
  EXPECT_EQ(scan->refused, 1U);
}

TEST(VelodyneText, RefusesOtherLinesByNumber) {
  for (const std::string bad : {"1 2 3", "1 2 3 4 5", "1 2 x 4"}) {
    const auto scan = parse_velodyne_text("1 2 3 4\n" + bad + "\n", "a.txt");
    ASSERT_FALSE(scan);
    EXPECT_THAT(scan.error().message, AllOf(HasSubstr("a.txt:2"), HasSubstr(bad)));
  }
}

}  // namespace
}  // namespace sparsight
