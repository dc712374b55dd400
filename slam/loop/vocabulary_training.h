#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam/loop/vocabulary.h"

namespace sparsight {

struct VocabularyTrainingConfig {
  int branches = 10;
  int levels = 4;
  int max_iterations = 10;  // of each clustering
  std::uint64_t seed = 1;
};

// The descriptors of one image.
using ImageDescriptors = std::vector<BinaryDescriptor>;

// Clusters descriptors level by level: seeds far from each other as in k-means++ (Arthur and
// Vassilvitskii 2007), the centre of a cluster is the majority of each bit, which is its median
// under Hamming distance (Galvez-Lopez and Tardos 2012, Sec. III). A word's weight is the logarithm
// of the images over the images that show it. The same input gives the same vocabulary everywhere.
Vocabulary train_vocabulary(std::span<const ImageDescriptors> images,
                            const VocabularyTrainingConfig& config);

}  // namespace sparsight
