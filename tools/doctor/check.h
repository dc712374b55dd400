#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hal/time.h"

namespace sparsight {

enum class Verdict : std::uint8_t {
  kOk,
  kWarn,  // works, but not as well as it should
  kFail,  // the rig cannot be used so
};

// One answer to "is the rig fit?".
struct Check {
  std::string name;
  Verdict verdict = Verdict::kOk;
  std::string found;
  std::string fix;  // what to do; "" where nothing is to be done
  std::vector<std::pair<std::string, double>> figures = {};  // of `found`, for machines
};

using Now = std::function<HostTime()>;

}  // namespace sparsight
