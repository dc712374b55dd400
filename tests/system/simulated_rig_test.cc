#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

ProgramRun replay_to(const fs::path& recording, const fs::path& session) {
  return run_sparsight({"replay", recording, "--output", session, "--no-map", "--quiet"});
}

// Packets, edges and clocks all the way to a path: a short walk, as a recording.
TEST(SimulatedRecording, IsTrackedFromItsPacketsAndEdgesAndTwiceTheSame) {
  const fs::path folder = scratch_folder();
  const fs::path recording = folder / "walk.mcap";
  const ProgramRun simulation =
      run_sparsight({"simulate", "--scene", "corridor", "--duration", "5", "--seed", "3", "--size",
                     "320x240", "--output", recording, "--quiet"});
  ASSERT_EQ(simulation.exit_code, 0) << simulation.errors;
  EXPECT_EQ(pose_count(folder / "walk.ground_truth.tum"), 150U);

  const ProgramRun first = replay_to(recording, folder / "first");
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const json session = json::parse(text_of(folder / "first" / "session.json"));
  EXPECT_EQ(session.at("predicted"), 0);
  EXPECT_GE(session.at("frames"), 140) << "all but those before the edges are trusted";
  const ProgramRun evaluation =
      run_sparsight({"evaluate", folder / "first" / "trajectory.tum", "--ground-truth",
                     folder / "walk.ground_truth.tum", "--json"});
  ASSERT_EQ(evaluation.exit_code, 0) << evaluation.errors;
  EXPECT_LE(json::parse(evaluation.output).at("ate").at("rmse_m").get<double>(), 0.02);

  ASSERT_EQ(replay_to(recording, folder / "second").exit_code, 0);
  EXPECT_EQ(text_of(folder / "first" / "trajectory.tum"),
            text_of(folder / "second" / "trajectory.tum"));
}

TEST(SimulatedRecording, ThatWasCutOffIsReadAsFarAsItGoesAndRecovered) {
  const fs::path folder = scratch_folder();
  const fs::path recording = folder / "walk.mcap";
  const ProgramRun simulation =
      run_sparsight({"simulate", "--scene", "hall", "--duration", "3", "--seed", "1", "--size",
                     "160x120", "--output", recording, "--quiet"});
  ASSERT_EQ(simulation.exit_code, 0) << simulation.errors;
  fs::resize_file(recording, fs::file_size(recording) * 9 / 10);

  const ProgramRun cut = replay_to(recording, folder / "cut");
  EXPECT_EQ(cut.exit_code, 0) << cut.errors;
  EXPECT_NE(text_of(folder / "cut" / "session.json").find("cut off"), std::string::npos);

  const fs::path recovered = folder / "recovered.mcap";
  const ProgramRun recovery = run_sparsight({"recover", recording, "--output", recovered});
  ASSERT_EQ(recovery.exit_code, 0) << recovery.errors;
  ASSERT_EQ(replay_to(recovered, folder / "whole").exit_code, 0);
  EXPECT_EQ(text_of(folder / "cut" / "trajectory.tum"),
            text_of(folder / "whole" / "trajectory.tum"));
}

}  // namespace
}  // namespace sparsight
