#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hal/result.h"

namespace sparsight {

// A line of the kernel's GPIO simulator (Documentation/admin-guide/gpio/gpio-sim.rst), driven from
// outside through its pull. Thread-bound.
class SimulatedLine {
 public:
  // `chip` as in a rig's file, "/dev/gpiochip0"; `offset` counts its lines.
  static Result<SimulatedLine> open(const std::string& chip, unsigned offset,
                                    const std::filesystem::path& sysfs = "/sys/bus/gpio/devices");
  ~SimulatedLine();
  SimulatedLine(SimulatedLine&& other) noexcept;
  SimulatedLine(const SimulatedLine&) = delete;
  SimulatedLine& operator=(const SimulatedLine&) = delete;
  SimulatedLine& operator=(SimulatedLine&&) = delete;

  // 0, or a negative errno. A level that the line has already makes no edge.
  int pull(bool high);
  bool is_high() const { return high_; }

 private:
  explicit SimulatedLine(int fd) : fd_(fd) {}

  int fd_;
  bool high_ = false;
};

}  // namespace sparsight
