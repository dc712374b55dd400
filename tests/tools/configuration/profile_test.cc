#include "tools/configuration/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/build_paths.h"
#include "tests/tools/configuration/field_counter.h"
#include "tools/configuration/odometry_fields.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

std::string error_of(std::string_view toml) {
  const auto config = parse_profile(toml, "my.toml");
  return config ? "no error" : config.error().message;
}

TEST(Profile, EveryShippedFileLoadsAndIsBuiltIn) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::source_dir() / "config")) {
    if (entry.path().extension() != ".toml") continue;  // config/rig/, the vocabulary
    const auto from_file = load_profile(entry.path());
    ASSERT_TRUE(from_file) << from_file.error().message;
    const auto built_in = load_profile(entry.path().stem());
    ASSERT_TRUE(built_in) << built_in.error().message;
    EXPECT_EQ(describe_profile(*from_file), describe_profile(*built_in));
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(Profile, HeaderDefaultsAreThePapers) {
  EXPECT_EQ(describe_profile(load_profile("paper").value()), describe_profile(OdometryConfig{}));
}

TEST(Profile, PaperIsTableOne) {
  const OdometryConfig paper = load_profile("paper").value();
  EXPECT_EQ(paper.keyframes.min_visible_ratio, 0.8);
  EXPECT_EQ(paper.keyframes.max_age_s, 1.0);
  EXPECT_EQ(paper.window.size, 5);
  EXPECT_EQ(paper.points.bin_deg, 2.0);
}

TEST(Profile, MissingKeysKeepTheDefaults) {
  const auto config = parse_profile("[window]\nsize = 7\n", "my.toml");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->window.size, 7);
  EXPECT_EQ(config->window.max_iterations, WindowConfig{}.max_iterations);
  EXPECT_EQ(config->points.bin_deg, PointSelectionConfig{}.bin_deg);
}

TEST(Profile, DescriptionGivesTheSameConfigurationBack) {
  OdometryConfig config;
  config.points.bin_deg = 0.1 + 0.2;  // needs all 17 digits
  config.points.max_depth_m = 80.0;
  config.points.reject_hidden = false;
  config.tracker.pyramid_levels = 3;
  const std::string toml = describe_profile(config);
  const auto again = parse_profile(toml, "described.toml");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->points.bin_deg, config.points.bin_deg);
  EXPECT_EQ(again->tracker.pyramid_levels, 3);
  EXPECT_FALSE(again->points.reject_hidden);
  EXPECT_EQ(describe_profile(*again), toml);
}

TEST(Profile, IntegersServeWhereFloatsAreExpected) {
  EXPECT_EQ(parse_profile("[points]\nbin_deg = 1\n", "my.toml").value().points.bin_deg, 1.0);
}

TEST(Profile, ValueOutOfRangeNamesFileLineFieldValueAndRange) {
  EXPECT_EQ(error_of("[keyframes]\n\nmin_visible_ratio = -0.1\n"),
            "my.toml:3: [keyframes] min_visible_ratio = -0.1: must be between 0 and 1");
  EXPECT_THAT(error_of("[points]\nbin_deg = nan\n"), HasSubstr("must be between"));
  EXPECT_THAT(error_of("[window]\nsize = 9223372036854775807\n"), HasSubstr("between 2 and 50"));
}

TEST(Profile, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(error_of("[keyframes]\nmin_visible = 0.5\n"),
            "my.toml:2: [keyframes] min_visible: unknown key; the nearest is min_visible_ratio");
  EXPECT_EQ(error_of("widnow = 5\n"), "my.toml:1: widnow: unknown key; the nearest is window");
}

TEST(Profile, UnknownTableNamesTheNearest) {
  EXPECT_EQ(error_of("[window]\nsize = 5\n[trakcer]\nmax_iterations = 3\n"),
            "my.toml:3: [trakcer]: unknown table; the nearest is [tracker]");
}

TEST(Profile, WrongTypeSaysWhatIsExpected) {
  EXPECT_EQ(error_of("[window]\nsize = 5.5\n"),
            "my.toml:2: [window] size = 5.5: must be a whole number");
  EXPECT_EQ(error_of("[points]\nbin_deg = \"2\"\n"),
            "my.toml:2: [points] bin_deg = '2': must be a number");
  EXPECT_EQ(error_of("[points]\nreject_hidden = 1\n"),
            "my.toml:2: [points] reject_hidden = 1: must be true or false");
  EXPECT_EQ(error_of("tracker = 3\n"), "my.toml:1: tracker = 3: must be a table, [tracker]");
}

TEST(Profile, AllErrorsAreReportedInTheOrderOfTheirLines) {
  EXPECT_EQ(error_of("[window]\nsize = 0\n[points]\nbin_deg = 0\n"),
            "my.toml:2: [window] size = 0: must be between 2 and 50\n"
            "my.toml:4: [points] bin_deg = 0: must be between 0.05 and 45");
}

TEST(Profile, MalformedTomlNamesTheLine) {
  EXPECT_THAT(error_of("[points]\nbin_deg = \n"), HasSubstr("my.toml:2: not TOML: "));
}

TEST(Profile, UnreadableFileNamesTheBuiltInOnes) {
  const auto config = load_profile("papre");
  ASSERT_FALSE(config);
  EXPECT_THAT(config.error().message, HasSubstr("papre: cannot read"));
  EXPECT_THAT(config.error().message, HasSubstr("default, paper"));
  EXPECT_FALSE(load_profile("/"));
}

TEST(Profile, NoFieldOfTheStructsIsForgotten) {
  OdometryConfig config;
  testing::FieldCounter fields;
  visit_fields(fields, config);
  EXPECT_EQ(fields.count, testing::member_count<OdometryConfig>());
  EXPECT_EQ(testing::member_count<KeyframeConfig>(), 2);
}

}  // namespace
}  // namespace sparsight
