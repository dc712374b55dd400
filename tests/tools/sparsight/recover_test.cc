#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RecoverCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("recover.") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    auto writer = *RecordingWriter::create(folder_ / "cut.mcap", {});
    for (int i = 0; i < 3000; ++i) {
      ASSERT_TRUE(writer->write(LidarPacket{HostTime(std::chrono::milliseconds(i))}));
    }
    ASSERT_TRUE(writer->close());
    fs::resize_file(folder_ / "cut.mcap", fs::file_size(folder_ / "cut.mcap") / 2);
  }
  void TearDown() override { fs::remove_all(folder_); }

  int run(std::vector<std::string> arguments) {
    CLI::App app;
    int exit_code = -1;
    add_recover(app, exit_code);
    arguments.insert(arguments.begin(), "recover");
    std::reverse(arguments.begin(), arguments.end());
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    app.parse(arguments);
    output_ = ::testing::internal::GetCapturedStdout();
    errors_ = ::testing::internal::GetCapturedStderr();
    return exit_code;
  }

  fs::path folder_;
  std::string output_;
  std::string errors_;
};

TEST_F(RecoverCommand, WritesAnIndexedFileBesideTheDamagedOne) {
  EXPECT_EQ(run({(folder_ / "cut.mcap").string()}), 0);
  const fs::path whole = folder_ / "cut.recovered.mcap";
  EXPECT_THAT(output_, HasSubstr(whole.string() + ": "));
  auto source = RecordingSource::open(whole);
  ASSERT_TRUE(source);
  EXPECT_TRUE((*source)->info().indexed);
  EXPECT_GT((*source)->info().messages.at("/velodyne_packets"), 1000);

  EXPECT_EQ(run({(folder_ / "cut.mcap").string()}), 1);
  EXPECT_THAT(errors_, HasSubstr("exists already"));
}

TEST_F(RecoverCommand, TellsMachinesWhatItFound) {
  const std::string output = (folder_ / "out.mcap").string();
  EXPECT_EQ(run({(folder_ / "cut.mcap").string(), "--output", output, "--json"}), 0);
  const auto json = nlohmann::json::parse(output_);
  EXPECT_EQ(json["output"], output);
  EXPECT_EQ(json["was_whole"], false);
  EXPECT_EQ(json["bytes_written"], fs::file_size(output));
  EXPECT_GT(json["messages"], 1000);
}

TEST_F(RecoverCommand, FailsOnWhatIsNotThere) {
  EXPECT_EQ(run({(folder_ / "none.mcap").string()}), 1);
  EXPECT_THAT(errors_, HasSubstr("none.mcap: cannot be opened"));
}

}  // namespace
}  // namespace sparsight
