#pragma once

#include <optional>
#include <string_view>

namespace sparsight {

// Translational error in percent, as published in Table II of Shin, Park, Kim (ICRA 2018): left
// grey camera, no loop closure. The table's own average is the arithmetic mean of its rows.
struct PublishedErrors {
  std::string_view sequence;
  double demo;    // Zhang et al., depth-enhanced monocular odometry, 64 rays
  double dvl_64;  // the paper's method, by number of rays
  double dvl_16;
  double dvl_8;
};

std::optional<PublishedErrors> published_errors(std::string_view sequence);

}  // namespace sparsight
