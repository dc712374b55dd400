#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/result.h"

namespace sparsight {

// A sequence of the KITTI odometry layout that can be replayed.
struct KittiSequence {
  std::string name;                            // "04"
  std::filesystem::path folder;                // ROOT/sequences/04
  std::optional<std::filesystem::path> truth;  // ROOT/poses/04.txt, which is of camera 0
  std::size_t images = 0;
};

struct KittiSequences {
  std::vector<KittiSequence> found;  // in the order of their names
  std::vector<std::string> notes;    // folders passed over, and why
};

// Every folder of ROOT/sequences (or ROOT/dataset/sequences, as the archives unpack) that has
// images and scans; with `wanted`, only those, each of which must be there.
Result<KittiSequences> find_kitti_sequences(const std::filesystem::path& root,
                                            const std::vector<std::string>& wanted);

}  // namespace sparsight
