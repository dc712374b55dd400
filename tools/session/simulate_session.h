#pragma once

#include <string>

#include "drivers/simulated/simulated_rig.h"
#include "drivers/simulated/simulation_options.h"
#include "hal/result.h"
#include "tools/session/progress.h"

namespace sparsight {

struct SimulateSession {
  SimulationOptions options;
  std::string output;  // recording; "" for none
  std::string frames;  // folder of PNG files; "" for none
};

// Where the ground truth of a recording goes: beside it.
std::string ground_truth_path(const std::string& recording);

// Simulates and writes; returns a summary for a person. Ends early, with what there is complete,
// when it is interrupted.
Result<std::string> run_simulation(const SimulateSession& session, Progress::Style progress);

}  // namespace sparsight
