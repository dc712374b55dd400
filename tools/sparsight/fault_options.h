#pragma once

#include <chrono>
#include <string>

#include "drivers/simulated/simulation_options.h"

namespace sparsight {

std::chrono::nanoseconds seconds_given(double seconds);

// --away DEVICE:FROM:SECONDS, added to the faults; false if it cannot be read.
bool read_away(const std::string& text, SimulatedFaults& faults);
std::string away_usage(const std::string& text);
// --cover FROM:SECONDS and --carry AT:AHEAD, likewise.
bool read_cover(const std::string& text, SimulatedFaults& faults);
std::string cover_usage(const std::string& text);
bool read_carry(const std::string& text, SimulatedFaults& faults);
std::string carry_usage(const std::string& text);

}  // namespace sparsight
