#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/system/made_recording.h"
#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

void truncate(const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2 + 3); }

void fill_with_nan(const fs::path& file) {
  const std::vector<float> points(4 * 500, std::numeric_limits<float>::quiet_NaN());
  write(file, {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(float)});
}

// One bad file in the middle of a recording: what happens to it, and what of its name is told.
struct Damage {
  const char* name;
  const char* told;
  std::function<void(const fs::path& sequence)> inflict;

  friend void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }
};

class OneBadFile : public ::testing::TestWithParam<Damage> {};

TEST_P(OneBadFile, IsSkippedCountedAndReported) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_corridor(), 10, root / "data");
  GetParam().inflict(sequence);
  const fs::path session = root / "session";
  const ProgramRun run = run_sparsight({"replay", sequence, "--output", session});
  ASSERT_EQ(run.exit_code, 0) << run.errors;
  EXPECT_THAT(run.errors + run.output, HasSubstr(GetParam().told));
  EXPECT_EQ(pose_count(session / "trajectory.kitti"), 10U);
  const auto summary = nlohmann::json::parse(text_of(session / "session.json"));
  EXPECT_FALSE(summary.at("faults").empty());
  EXPECT_LE(summary.at("predicted").get<int>(), 1);
  EXPECT_LT(summary.at("accuracy").at("ate_rmse_m").get<double>(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, OneBadFile,
    ::testing::Values(Damage{"MissingImage", "000006.png",
                             [](const fs::path& s) { fs::remove(s / "image_0/000006.png"); }},
                      Damage{"TruncatedImage", "000006.png",
                             [](const fs::path& s) { truncate(s / "image_0/000006.png"); }},
                      Damage{"EmptyImage", "000006.png",
                             [](const fs::path& s) { write(s / "image_0/000006.png", ""); }},
                      Damage{"MissingScan", "000006.bin",
                             [](const fs::path& s) { fs::remove(s / "velodyne/000006.bin"); }},
                      Damage{"TruncatedScan", "000006.bin",
                             [](const fs::path& s) { truncate(s / "velodyne/000006.bin"); }},
                      Damage{"EmptyScan", "000006.bin",
                             [](const fs::path& s) { write(s / "velodyne/000006.bin", ""); }},
                      Damage{"ScanOfNan", "000006.bin",
                             [](const fs::path& s) { fill_with_nan(s / "velodyne/000006.bin"); }}),
    [](const auto& instance) { return instance.param.name; });

// What makes a recording or a command useless: exit code, and what the message must name.
struct Refusal {
  const char* name;
  int exit_code;
  std::vector<std::string> named;
  std::function<void(const fs::path& sequence)> inflict = [](const fs::path&) {};
  std::vector<std::string> more_arguments = {};

  friend void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }
};

class UselessInput : public ::testing::TestWithParam<Refusal> {};

TEST_P(UselessInput, IsRefusedWithItsPlaceAndNothingIsWritten) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_corridor(), 2, root / "data");
  GetParam().inflict(sequence);
  std::vector<std::string> arguments{"replay", sequence, "--output", root / "session"};
  const auto& more = GetParam().more_arguments;
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramRun run = run_sparsight(arguments);
  EXPECT_EQ(run.exit_code, GetParam().exit_code) << run.errors;
  for (const std::string& part : GetParam().named) EXPECT_THAT(run.errors, HasSubstr(part));
  EXPECT_FALSE(fs::exists(root / "session" / "trajectory.kitti"));
}

void drop_line(const fs::path& file, const std::string& beginning) {
  std::istringstream in(text_of(file));
  std::string kept;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(beginning)) kept += line + "\n";
  }
  write(file, kept);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, UselessInput,
    ::testing::Values(
        Refusal{"CalibrationWithoutTr",
                1,
                {"calib.txt", "Tr"},
                [](const fs::path& s) { drop_line(s / "calib.txt", "Tr"); }},
        Refusal{"CalibrationMissing",
                1,
                {"calib.txt"},
                [](const fs::path& s) { fs::remove(s / "calib.txt"); }},
        Refusal{"TimesGoBackwards",
                1,
                {"times.txt", "2"},
                [](const fs::path& s) { write(s / "times.txt", "0.1\n0.0\n"); }},
        Refusal{
            "NoImages", 1, {"no images"}, [](const fs::path& s) { fs::remove_all(s / "image_0"); }},
        Refusal{"SourceMissing", 1, {"00"}, [](const fs::path& s) { fs::remove_all(s); }},
        Refusal{
            "UnknownProfile", 2, {"nonesuch"}, [](const fs::path&) {}, {"--profile", "nonesuch"}},
        Refusal{"RaysNotPositive", 2, {"--rays"}, [](const fs::path&) {}, {"--rays", "0"}},
        Refusal{"UnknownOption", 2, {"--nonesuch"}, [](const fs::path&) {}, {"--nonesuch"}}),
    [](const auto& instance) { return instance.param.name; });

TEST(UselessInput, AnUnknownConfigurationKeyIsNamedWithFileAndLine) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_corridor(), 2, root / "data");
  write(root / "mine.toml", "[points]\nbin_deg = 2.0\nbin_size = 3\n");
  const ProgramRun run = run_sparsight({"replay", sequence, "--profile", root / "mine.toml"});
  EXPECT_EQ(run.exit_code, 2);
  for (const char* part : {"mine.toml", "3", "bin_size"}) EXPECT_THAT(run.errors, HasSubstr(part));
}

TEST(UselessInput, AnImageOfAnotherSizeIsAFaultOfItsFrame) {
  const fs::path root = scratch_folder();
  const fs::path sequence = make_odometry_sequence(small_corridor(), 10, root / "data");
  synthetic::Scene smaller = small_corridor();
  smaller.resize(200, 150);
  const fs::path other = make_odometry_sequence(smaller, 1, root / "other");
  fs::copy_file(other / "image_0/000000.png", sequence / "image_0/000005.png",
                fs::copy_options::overwrite_existing);
  const ProgramRun run = run_sparsight({"replay", sequence, "--output", root / "session"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.errors + run.output, HasSubstr("000005.png"));
  EXPECT_EQ(pose_count(root / "session" / "trajectory.kitti"), 10U);
}

}  // namespace
}  // namespace sparsight
