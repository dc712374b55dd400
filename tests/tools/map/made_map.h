#pragma once

#include "slam/geometry/se3.h"
#include "tests/tools/map/made_keyframe.h"
#include "tools/map/map_index.h"

namespace sparsight::testing {

// Two sessions of five keyframes each, the second joined to the first by a loop.
inline MapIndex made_index() {
  MapIndex index{.vocabulary = 77,
                 .sessions = {"first.mcap", "second.mcap"},
                 .files = {{"keyframes-0001.bin", 5000}, {"keyframes-0002.bin", 7000}}};
  for (std::uint32_t i = 0; i < 10; ++i) {
    Vector6d motion;
    motion << 0.01 * i, -0.3, 0.002, 0.5 * i, 0.1, -0.2 * i;
    index.known.keyframes.push_back(
        {.session = i / 5,
         .sequence = 7 * (i % 5),
         .submap = 5 * (i / 5),
         .camera = {400, 300, 200 + 0.1 * i, 201, 199.5, 149.5, -0.01, 0.002, 0, 1e-4, 0},
         .T_odometry_camera = exp_se3(motion),
         .T_map_camera = exp_se3(-motion),
         .bag = {{i, 0.25F}, {i + 100, 0.75F}}});
    index.places.push_back({.file = i / 5, .record = KeyframePlace{900 * (i % 5), 900}});
    if (i == 0 || i == 5) continue;
    Matrix6d information = Vector6d::LinSpaced(1.0, 40.0 + i).asDiagonal();
    information(0, 4) = information(4, 0) = 0.5;
    index.known.edges.push_back(
        {.from = i - 1, .to = i, .T_from_to = exp_se3(motion), .information = information});
  }
  index.places[3].record.reset();
  index.known.edges.push_back({.from = 8, .to = 2, .loop = true});
  return index;
}

}  // namespace sparsight::testing
