#pragma once

namespace sparsight {

struct WindowConfig {
  int size = 5;  // N_w of Table I
  int max_iterations = 10;
};

}  // namespace sparsight
