#pragma once

#include <memory>

#include "drivers/gpio/pps_port.h"

namespace sparsight {

// A GPIO output line by libgpiod and a serial port at 9600 8N1.
std::unique_ptr<PpsPort> linux_pps_port();

}  // namespace sparsight
