#include "tools/cloud/pcd_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace sparsight {
namespace {

std::string written(const std::vector<MapPoint>& points) {
  const auto path = std::filesystem::path(::testing::TempDir()) / "map.pcd";
  EXPECT_TRUE(write_pcd(path, points));
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(PcdWriter, HeaderIsThatOfVersion07) {
  const std::string text = written({MapPoint{}, MapPoint{}, MapPoint{}});
  const std::string header = text.substr(0, text.find("DATA binary\n"));
  EXPECT_THAT(header, ::testing::StartsWith("# .PCD v0.7 - Point Cloud Data file format\n"));
  EXPECT_THAT(header, ::testing::EndsWith("VERSION 0.7\nFIELDS x y z rgb intensity\n"
                                          "SIZE 4 4 4 4 4\nTYPE F F F F F\nCOUNT 1 1 1 1 1\n"
                                          "WIDTH 3\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                                          "POINTS 3\n"));
  EXPECT_EQ(text.size(), header.size() + 12 + 3 * 20);
}

TEST(PcdWriter, PointsAreAsPclPacksThem) {
  const std::string text =
      written({{.p_world = {1.5F, -2.5F, 3.5F}, .intensity = 7.0F, .rgb = {0x11, 0x22, 0x33}}});
  const char* point = text.data() + text.size() - 20;
  float numbers[5];
  std::uint32_t rgb = 0;
  std::memcpy(numbers, point, 20);
  std::memcpy(&rgb, point + 12, 4);
  EXPECT_EQ(numbers[0], 1.5F);
  EXPECT_EQ(numbers[1], -2.5F);
  EXPECT_EQ(numbers[2], 3.5F);
  EXPECT_EQ(rgb, 0x00112233U);
  EXPECT_EQ(numbers[4], 7.0F);
}

TEST(PcdWriter, FolderThatIsNotThereIsAnErrorThatNamesTheFile) {
  const auto result = write_pcd("/nonexistent/map.pcd", {});
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, ::testing::HasSubstr("/nonexistent/map.pcd"));
}

}  // namespace
}  // namespace sparsight
