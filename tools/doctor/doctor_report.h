#pragma once

#include <string>
#include <vector>

#include "tools/doctor/check.h"

namespace sparsight {

// Fit as long as no check fails.
bool is_fit(const std::vector<Check>& checks);

// A line per check, and what to do beneath those that need it.
std::string doctor_text(const std::vector<Check>& checks);
// {"fit": bool, "checks": [{"name", "verdict": "ok"|"warn"|"fail", "found", "fix", "figures"?:
// {}}]}
std::string doctor_json(const std::vector<Check>& checks);

}  // namespace sparsight
