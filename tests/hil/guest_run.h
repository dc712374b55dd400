#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/evaluation/evaluation.h"
#include "tools/evaluation/trajectory.h"
#include "tools/playback/recording_comparison.h"

namespace sparsight {

// What one scenario left in its folder (tests/hil/run_in_guest.sh); what is missing is empty.
struct GuestRun {
  std::filesystem::path folder;
  int run_status = -1;
  int hil_status = -1;
  std::chrono::nanoseconds moved_by{0};  // played minus recorded
  nlohmann::json hil;
  nlohmann::json session;
  std::vector<nlohmann::json> states;  // a second apart
  std::string said;                    // by sparsight run, to a person
  Trajectory path;                     // by the recording's own clock
  RecordingComparison recorded;        // with what went in

  // The states from a second after the first pose to the end: what comes before is the start.
  const nlohmann::json& settled() const;
  const nlohmann::json& last() const { return states.back(); }
  // Whether some state had this value at this place, as "/camera/state".
  bool showed(const std::string& pointer, const nlohmann::json& value) const;
};

// The recording that went in, and what it is compared with.
const std::filesystem::path& recording_played();
const Trajectory& true_path();
// By the deterministic replay of the recording that went in, here.
const Trajectory& replayed_path();
Trajectory replay(const std::filesystem::path& recording);

// Fails the test if the scenario has left nothing that can be judged.
GuestRun guest_run(const std::string& scenario);

// Positions moved onto the truth as a whole; fails the test if that cannot be done.
AbsoluteError error_of(const Trajectory& path);

}  // namespace sparsight
