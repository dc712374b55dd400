#pragma once

#include <cstddef>
#include <filesystem>

#include "tests/synthetic/scene.h"

namespace sparsight {

// Recordings small enough to be made within a test, large enough to be tracked.

// The street at half size; only what is about the camera's field of view is scanned.
synthetic::Scene small_street();
// The hand-held corridor at half size.
synthetic::Scene small_corridor();
// Before a crossing at half size: cars cross, and others leave from beside us.
synthetic::Scene small_lights();

// The folders a person would give to `sparsight replay`.
std::filesystem::path make_odometry_sequence(const synthetic::Scene& scene, std::size_t frames,
                                             const std::filesystem::path& root);
std::filesystem::path make_raw_drive(synthetic::Scene scene, std::size_t frames,
                                     const std::filesystem::path& root);

}  // namespace sparsight
