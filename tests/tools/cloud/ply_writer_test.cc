#include "tools/cloud/ply_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

namespace sparsight {
namespace {

std::string ply_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

std::filesystem::path scratch_file(const char* name) {
  return std::filesystem::path(::testing::TempDir()) / name;
}

TEST(PlyWriter, HeaderDeclaresWhatCloudCompareAndMeshLabRead) {
  const auto path = scratch_file("header.ply");
  ASSERT_TRUE(write_ply(path, {MapPoint{}, MapPoint{}}));
  const std::string text = ply_text(path);
  const std::string header = text.substr(0, text.find("end_header\n"));
  EXPECT_THAT(header, ::testing::StartsWith("ply\nformat binary_little_endian 1.0\ncomment "));
  EXPECT_THAT(header, ::testing::HasSubstr("x right, y down, z forward\n"));
  EXPECT_THAT(header, ::testing::EndsWith("element vertex 2\n"
                                          "property float x\nproperty float y\nproperty float z\n"
                                          "property uchar red\nproperty uchar green\n"
                                          "property uchar blue\nproperty float intensity\n"));
}

TEST(PlyWriter, VerticesReadBackAsTheyWere) {
  std::vector<MapPoint> points;
  for (int i = 0; i < 300; ++i) {
    const auto number = static_cast<float>(i);
    points.push_back({.p_world = {number, -0.5F * number, 1e-3F * number},
                      .intensity = 0.25F * number,
                      .rgb = {static_cast<std::uint8_t>(i), 10, 13}});
  }
  const auto path = scratch_file("vertices.ply");
  ASSERT_TRUE(write_ply(path, points));
  const std::string text = ply_text(path);
  const std::string end = "end_header\n";
  const std::string vertices = text.substr(text.find(end) + end.size());
  ASSERT_EQ(vertices.size(), 19 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    float xyz[3];
    float intensity;
    std::memcpy(xyz, vertices.data() + 19 * i, 12);
    std::memcpy(&intensity, vertices.data() + 19 * i + 15, 4);
    EXPECT_EQ(Eigen::Vector3f(xyz[0], xyz[1], xyz[2]), points[i].p_world);
    EXPECT_EQ(static_cast<std::uint8_t>(vertices[19 * i + 12]), points[i].rgb[0]);
    EXPECT_EQ(intensity, points[i].intensity);
  }
}

TEST(PlyWriter, FolderThatIsNotThereIsAnErrorThatNamesTheFile) {
  const auto written = write_ply("/nonexistent/map.ply", {});
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, ::testing::HasSubstr("/nonexistent/map.ply"));
}

}  // namespace
}  // namespace sparsight
