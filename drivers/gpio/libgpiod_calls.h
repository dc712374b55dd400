#pragma once

#include "drivers/gpio/gpio_calls.h"

namespace sparsight {

// The kernel's lines by libgpiod 1.6.
GpioCalls& libgpiod_calls();

}  // namespace sparsight
