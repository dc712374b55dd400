#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

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

// A path's lines, as if all of it had happened later.
std::string later(const std::string& tum, double seconds) {
  std::istringstream lines(tum);
  std::ostringstream result;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t blank = line.find(' ');
    result << fmt::format("{:.9f}{}\n", std::stod(line.substr(0, blank)) + seconds,
                          line.substr(blank));
  }
  return result.str();
}

// Power comes back in the middle of a known place: on the second lap of a corridor of which the map
// has a third.
TEST(MapSession, BegunElsewhereInAKnownPlaceGoesOnInItsFrame) {
  const fs::path folder = scratch_folder();
  const auto record = [&](const char* name, std::vector<std::string> words) {
    words.insert(words.begin(), {"simulate", "--scene", "corridor", "--seed", "6", "--size",
                                 "400x300", "--rate", "15", "--quiet", "--output", folder / name});
    const ProgramRun made = run_sparsight(words);
    ASSERT_EQ(made.exit_code, 0) << made.errors;
  };
  record("first.mcap", {"--duration", "16"});
  record("second.mcap", {"--duration", "6", "--carry", "0:68"});
  const ProgramRun first = run_sparsight({"replay", folder / "first.mcap", "--output",
                                          folder / "first", "--save-map", folder / "map"});
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const ProgramRun second = run_sparsight(
      {"replay", folder / "second.mcap", "--output", folder / "second", "--map", folder / "map"});
  ASSERT_EQ(second.exit_code, 0) << second.errors;
  EXPECT_THAT(second.output, ::testing::HasSubstr("goes on in the map"));
  const std::size_t news = second.errors.find(": found: sub-map 0 lies in the earlier map");
  ASSERT_NE(news, std::string::npos) << second.errors;
  const std::size_t frame = second.errors.rfind("frame ", news);
  EXPECT_LE(std::stoi(second.errors.substr(frame + 6)), 60) << "within four seconds";

  // One path of both, moved onto the truth as a whole: what is in another frame would be metres
  // off.
  constexpr double kBetweenS = 1000.0;
  const auto joined = [&](const fs::path& name, const fs::path& of_first,
                          const fs::path& of_second) {
    std::ofstream(folder / name) << text_of(of_first) << later(text_of(of_second), kBetweenS);
  };
  joined("both.tum", folder / "first" / "trajectory.tum", folder / "second" / "trajectory.tum");
  joined("truth.tum", folder / "first.ground_truth.tum", folder / "second.ground_truth.tum");
  const ProgramRun evaluation = run_sparsight(
      {"evaluate", folder / "both.tum", "--ground-truth", folder / "truth.tum", "--json"});
  ASSERT_EQ(evaluation.exit_code, 0) << evaluation.errors;
  const json ate = json::parse(evaluation.output).at("ate");
  EXPECT_LE(ate.at("rmse_m").get<double>(), 0.02);
  EXPECT_LE(ate.at("max_m").get<double>(), 0.05);
}

}  // namespace
}  // namespace sparsight
