#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/tools/evaluation/paths.h"
#include "tools/benchmark/benchmark.h"
#include "tools/session/atomic_file.h"

// A small KITTI folder, and replays that take no time.
namespace sparsight::testing {

inline std::filesystem::path fresh_folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "benchmark" /
                                 test->test_suite_name() / test->name();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline void put(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  ASSERT_TRUE(write_file(file, text)) << file;
}

// Straight ground truth of that many metres and frames; 0: none.
inline void put_sequence(const std::filesystem::path& root, const std::string& name,
                         std::size_t frames, std::size_t truth_frames) {
  for (std::size_t i = 0; i < frames; ++i) {
    put(root / "sequences" / name / "image_0" / (std::to_string(i) + ".png"), "");
  }
  std::filesystem::create_directories(root / "sequences" / name / "velodyne");
  if (truth_frames > 0) {
    put(root / "poses" / (name + ".txt"), format_kitti(straight_path(truth_frames).poses));
  }
}

// Leaves the session of a path stretched by one percent per ten rays.
inline void put_session(const ReplayRun& run, bool complete = true) {
  const Trajectory path = straight_path(run.frames(), 1.0 + 0.001 * run.rays);
  put(run.session / "trajectory.kitti", format_kitti(path.poses));
  put(run.session / "session.json",
      std::string("{\"complete\": ") + (complete ? "true" : "false") +
          ", \"tracking_ms\": {\"median\": 1.25, \"p99\": 4.5}, \"times_real_time\": 7.5}");
}

}  // namespace sparsight::testing
