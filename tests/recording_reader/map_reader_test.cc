#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/build_paths.h"
#include "tools/cloud/las_writer.h"

// The map as LAS 1.4, read by copc (the reader of the author of Entwine and COPC): what it checks
// of the format it checks there, here the points are compared.
namespace sparsight {
namespace {

using nlohmann::json;

json read_independently(const std::filesystem::path& file) {
  const auto reader = testing::build_dir() / "tests/recording_reader/npm/read_map.mjs";
  const std::string command =
      fmt::format("'{}' '{}' '{}' 2>&1", SPARSIGHT_NODE, reader.string(), file.string());
  std::string output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  char buffer[4096];
  while (const std::size_t count = fread(buffer, 1, sizeof(buffer), pipe)) {
    output.append(buffer, count);
  }
  EXPECT_EQ(WEXITSTATUS(pclose(pipe)), 0) << output;
  return json::parse(output, nullptr, false);
}

json written_and_read(const std::vector<MapPoint>& points) {
  // A name of this test's own: others run beside it.
  const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto file =
      std::filesystem::path(::testing::TempDir()) / ("read_elsewhere_" + name + ".las");
  EXPECT_TRUE(write_las(file, points, 255.0F));
  return read_independently(file);
}

TEST(IndependentMapReader, FindsEveryPointOfALasMap) {
  std::vector<MapPoint> points;
  json sums = {{"Intensity", 0}, {"Red", 0}, {"Green", 0}, {"Blue", 0}};
  for (int i = 0; i < 3000; ++i) {
    const auto number = static_cast<float>(i);
    const auto grey = static_cast<std::uint8_t>(i);
    points.push_back({.p_world = {500.0F + 0.01F * number, -0.002F * number, -0.1F * number},
                      .intensity = static_cast<float>(i % 256),
                      .rgb = {grey, static_cast<std::uint8_t>(grey / 2), 13}});
    sums["Intensity"] = sums["Intensity"].get<int>() + 257 * (i % 256);
    sums["Red"] = sums["Red"].get<int>() + 257 * grey;
    sums["Green"] = sums["Green"].get<int>() + 257 * (grey / 2);
    sums["Blue"] = sums["Blue"].get<int>() + 257 * 13;
  }
  const json found = written_and_read(points);
  EXPECT_EQ(found["header"]["pointCount"], 3000);
  EXPECT_EQ(found["header"]["pointDataRecordFormat"], 7);
  EXPECT_EQ(found["header"]["globalEncoding"], 16);
  EXPECT_EQ(found["header"]["scale"], json({0.001, 0.001, 0.001}));
  EXPECT_EQ(found["vlrs"].size(), 1);
  EXPECT_THAT(found["wkt"].get<std::string>(), ::testing::StartsWith("LOCAL_CS["));
  EXPECT_EQ(found["sums"], sums);
  EXPECT_NEAR(found["last"]["X"].get<double>(), 529.99, 0.0006);
  EXPECT_NEAR(found["last"]["Y"].get<double>(), -299.9, 0.0006);
  EXPECT_NEAR(found["last"]["Z"].get<double>(), 5.998, 0.0006);
  EXPECT_EQ(found["last"]["Intensity"], 257 * (2999 % 256));
}

TEST(IndependentMapReader, ReadsAMapOfNoPoints) {
  const json found = written_and_read({});
  EXPECT_EQ(found["header"]["pointCount"], 0);
  EXPECT_FALSE(found.contains("first"));
}

}  // namespace
}  // namespace sparsight
