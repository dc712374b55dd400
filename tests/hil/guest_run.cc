#include "tests/hil/guest_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "tests/system/program.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// tools/hil says where everything is.
fs::path given(const char* variable) {
  const char* value = std::getenv(variable);
  EXPECT_NE(value, nullptr) << variable << " is not set; tools/hil sets it";
  return value ? value : "";
}

int number_in(const fs::path& file) {
  const std::string text = text_of(file);
  return text.empty() ? -1 : std::atoi(text.c_str());
}

json json_in(const fs::path& file) {
  json parsed = json::parse(text_of(file), nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << file << " is no JSON: " << text_of(file);
  return parsed;
}

std::vector<json> lines_in(const fs::path& file) {
  std::vector<json> lines;
  std::istringstream text(text_of(file));
  for (std::string line; std::getline(text, line);) {
    json parsed = json::parse(line, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << file << ": " << line;
    if (!parsed.is_discarded()) lines.push_back(std::move(parsed));
  }
  return lines;
}

Trajectory path_in(const fs::path& file, std::chrono::nanoseconds later) {
  auto path = read_trajectory(file);
  if (!path) return {};
  for (HostTime& time : path->times) time -= later;
  return std::move(*path);
}

}  // namespace

const json& GuestRun::settled() const {
  const auto tracking = std::ranges::find_if(
      states, [](const json& state) { return state.at("state") == "tracking"; });
  const auto left = states.end() - tracking;
  return tracking[left > 1 ? 1 : 0];
}

bool GuestRun::showed(const std::string& pointer, const json& value) const {
  return std::ranges::any_of(
      states, [&](const json& state) { return state.at(json::json_pointer(pointer)) == value; });
}

const fs::path& recording_played() {
  static const fs::path file = given("SPARSIGHT_HIL_RECORDING");
  return file;
}

const Trajectory& true_path() {
  static const Trajectory path = [] {
    fs::path file = recording_played();
    return path_in(file.replace_extension(".ground_truth.tum"), {});
  }();
  return path;
}

Trajectory replay(const fs::path& recording) {
  const fs::path folder = scratch_folder() / "replay";
  const ProgramRun run =
      run_sparsight({"replay", recording, "--profile", given("SPARSIGHT_HIL_PROFILE"), "--output",
                     folder, "--no-map", "--quiet"});
  EXPECT_EQ(run.exit_code, 0) << run.errors;
  return path_in(folder / "trajectory.tum", {});
}

const Trajectory& replayed_path() {
  static const Trajectory path = replay(recording_played());
  return path;
}

GuestRun guest_run(const std::string& scenario) {
  GuestRun run{.folder = given("SPARSIGHT_HIL_RESULTS") / scenario};
  run.run_status = number_in(run.folder / "run.status");
  run.hil_status = number_in(run.folder / "hil.status");
  run.hil = json_in(run.folder / "hil.json");
  run.session = json_in(run.folder / "session" / "session.json");
  run.states = lines_in(run.folder / "states.jsonl");
  run.said = text_of(run.folder / "run.txt");
  if (run.hil.is_discarded() || run.states.empty()) {
    ADD_FAILURE() << run.folder << " holds nothing to judge: " << run.said
                  << text_of(run.folder / "hil.txt");
    run.states.resize(1);
    return run;
  }
  run.moved_by = std::chrono::nanoseconds(run.hil.at("moved_by_ns").get<std::int64_t>());
  run.path = path_in(run.folder / "session" / "trajectory.tum", run.moved_by);
  const auto recorded = compare_recordings(recording_played(),
                                           run.folder / "session" / "recording.mcap", run.moved_by);
  if (recorded) run.recorded = *recorded;
  EXPECT_TRUE(recorded) << recorded.error().message;
  return run;
}

AbsoluteError error_of(const Trajectory& path) {
  const auto evaluation = evaluate_trajectories(path, true_path(), {});
  EXPECT_TRUE(evaluation) << evaluation.error().message;
  return evaluation ? evaluation->ate : AbsoluteError{.rmse_m = 1e9, .max_m = 1e9};
}

}  // namespace sparsight
