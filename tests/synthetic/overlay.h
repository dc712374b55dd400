#pragma once

#include <filesystem>

#include "tests/synthetic/scene.h"

namespace sparsight::synthetic {

// The frame's returns drawn over its image, near red to far blue: for eyes. Returns measured on the
// move are carried to the exposure with the true trajectory.
void write_overlay(const Scene& scene, std::size_t frame, const std::filesystem::path& file);

}  // namespace sparsight::synthetic
