#include "tools/session/simulate_session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace sparsight {
namespace {

namespace fs = std::filesystem;

TEST(SimulateSession, WritesARecordingWithItsGroundTruthBesideIt) {
  const fs::path folder = fs::path(::testing::TempDir()) / "simulate_session";
  fs::remove_all(folder);
  fs::create_directories(folder);
  SimulateSession session;
  session.options.duration = std::chrono::milliseconds(200);
  session.options.width = 64;
  session.options.height = 48;
  session.options.light_detail = 0.05;
  session.output = folder / "lap.mcap";
  session.frames = folder / "frames";
  const Result<std::string> summary = run_simulation(session, Progress::Style::kQuiet);
  ASSERT_TRUE(summary) << summary.error().message;
  EXPECT_GT(fs::file_size(session.output), 100'000U);
  std::ifstream truth(ground_truth_path(session.output));
  const std::string text{std::istreambuf_iterator<char>(truth), {}};
  const auto poses = std::ranges::count(text, '\n');
  EXPECT_GE(poses, 5);
  const auto images =
      std::ranges::count_if(fs::directory_iterator(session.frames),
                            [](const auto& entry) { return entry.path().extension() == ".png"; });
  EXPECT_EQ(images, poses);
  // A recording is never written over.
  EXPECT_FALSE(run_simulation(session, Progress::Style::kQuiet));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sparsight
