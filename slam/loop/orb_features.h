#pragma once

#include <Eigen/Core>
#include <vector>

#include "hal/image.h"
#include "slam/loop/binary_descriptor.h"

namespace sparsight {

struct OrbConfig {
  int features = 800;
  int levels = 6;
  double scale_factor = 1.2;
  int fast_threshold = 10;  // grey levels
};

// ORB features (Rublee, Rabaud, Konolige and Bradski, ICCV 2011), as OpenCV finds them, the
// strongest of each part of the image.
struct OrbFeatures {
  std::vector<Eigen::Vector2f> pixels;
  std::vector<BinaryDescriptor> descriptors;
};
OrbFeatures orb_features(const GreyImage& image, const OrbConfig& config);

// Pairs of features (indices into a and b), each the other's nearest and clearly nearer than the
// second.
struct FeatureMatch {
  std::size_t a = 0;
  std::size_t b = 0;
};
std::vector<FeatureMatch> match_features(const OrbFeatures& a, const OrbFeatures& b);

}  // namespace sparsight
