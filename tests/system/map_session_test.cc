#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What a person does on two days: map a place, come back with the map.
TEST(MapSession, IsFoundAgainByTheNextSessionAndLeftAsTheUnion) {
  const fs::path folder = scratch_folder();
  const fs::path recording = folder / "walk.mcap";
  const fs::path map = folder / "map";
  const ProgramRun made =
      run_sparsight({"simulate", "--scene", "hall", "--duration", "7", "--seed", "1", "--size",
                     "400x300", "--rate", "15", "--output", recording, "--quiet"});
  ASSERT_EQ(made.exit_code, 0) << made.errors;

  const ProgramRun first = run_sparsight({"replay", recording, "--output", folder / "first",
                                          "--save-map", map, "--map-format", "las,pcd", "--quiet"});
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  EXPECT_TRUE(fs::exists(folder / "first" / "map.las"));
  EXPECT_TRUE(fs::exists(folder / "first" / "map.pcd"));
  EXPECT_FALSE(fs::exists(folder / "first" / "map.ply"));
  EXPECT_FALSE(fs::exists(folder / "first" / "keyframes.partial"));

  const ProgramRun second = run_sparsight({"replay", recording, "--output", folder / "second",
                                           "--map", map, "--save-map", map, "--quiet"});
  ASSERT_EQ(second.exit_code, 0) << second.errors;
  const json session = json::parse(text_of(folder / "second" / "session.json"));
  ASSERT_FALSE(session.at("loops").empty());
  EXPECT_EQ(session.at("loops")[0].at("in_earlier_map"), true);
  EXPECT_THAT(session.at("notes").dump(), ::testing::HasSubstr("goes on in the map"));
  EXPECT_TRUE(fs::exists(map / "keyframes-0002.bin"));

  const std::string before = text_of(map / "map.index");
  const ProgramRun refused = run_sparsight(
      {"replay", recording, "--output", folder / "third", "--save-map", map, "--quiet"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.errors, ::testing::HasSubstr("not overwritten"));
  EXPECT_EQ(text_of(map / "map.index"), before);

  fs::resize_file(map / "map.index", before.size() / 2);
  const ProgramRun damaged =
      run_sparsight({"replay", recording, "--output", folder / "fourth", "--map", map, "--quiet"});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_THAT(damaged.errors, ::testing::HasSubstr("map.index: is cut off"));
}

}  // namespace
}  // namespace sparsight
