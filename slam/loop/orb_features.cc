#include "slam/loop/orb_features.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <opencv2/features2d.hpp>

namespace sparsight {
namespace {

constexpr int kColumns = 8;
constexpr int kRows = 6;
constexpr int kFoundPerKept = 4;
constexpr int kFarthestMatch = 64;       // bits of 256
constexpr double kNearerThanNext = 0.8;  // Lowe's ratio, for Hamming distances

// Lines of the image with little texture would have no feature if the strongest were taken of all.
std::vector<cv::KeyPoint> spread(const std::vector<cv::KeyPoint>& found, const cv::Size& size,
                                 std::size_t wanted) {
  std::vector<std::vector<cv::KeyPoint>> cells(kColumns * kRows);
  for (const cv::KeyPoint& point : found) {
    const int column = static_cast<int>(point.pt.x) * kColumns / size.width;
    const int row = static_cast<int>(point.pt.y) * kRows / size.height;
    cells[static_cast<std::size_t>(std::clamp(row, 0, kRows - 1) * kColumns +
                                   std::clamp(column, 0, kColumns - 1))]
        .push_back(point);
  }
  const auto stronger = [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
    if (a.response != b.response) return a.response > b.response;
    return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
  };
  std::size_t longest = 0;
  for (auto& cell : cells) {
    std::ranges::stable_sort(cell, stronger);
    longest = std::max(longest, cell.size());
  }
  std::vector<cv::KeyPoint> kept;
  for (std::size_t rank = 0; rank < longest && kept.size() < wanted; ++rank) {
    for (const auto& cell : cells) {
      if (rank < cell.size() && kept.size() < wanted) kept.push_back(cell[rank]);
    }
  }
  return kept;
}

BinaryDescriptor descriptor_of(const std::uint8_t* bytes) {
  BinaryDescriptor descriptor{};
  for (std::size_t i = 0; i < kDescriptorBytes; ++i) set_descriptor_byte(descriptor, i, bytes[i]);
  return descriptor;
}

struct Nearest {
  std::size_t index = 0;
  int distance = std::numeric_limits<int>::max();
  int second = std::numeric_limits<int>::max();

  void see(std::size_t candidate, int its_distance) {
    if (its_distance < distance) {
      second = distance;
      distance = its_distance;
      index = candidate;
    } else {
      second = std::min(second, its_distance);
    }
  }
  bool clear() const { return distance <= kFarthestMatch && distance < kNearerThanNext * second; }
};

}  // namespace

OrbFeatures orb_features(const GreyImage& image, const OrbConfig& config) {
  OrbFeatures features;
  constexpr int kSmallest = 64;  // pixels; ORB's patches need 31 and a border
  if (image.width < kSmallest || image.height < kSmallest) return features;
  const cv::Mat grey(image.height, image.width, CV_8U,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  const auto orb =
      cv::ORB::create(kFoundPerKept * config.features, static_cast<float>(config.scale_factor),
                      config.levels, 31, 0, 2, cv::ORB::FAST_SCORE, 31, config.fast_threshold);
  std::vector<cv::KeyPoint> found;
  orb->detect(grey, found);
  std::vector<cv::KeyPoint> kept =
      spread(found, grey.size(), static_cast<std::size_t>(config.features));
  cv::Mat descriptors;
  orb->compute(grey, kept, descriptors);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    features.pixels.emplace_back(kept[i].pt.x, kept[i].pt.y);
    features.descriptors.push_back(descriptor_of(descriptors.ptr(static_cast<int>(i))));
  }
  return features;
}

std::vector<FeatureMatch> match_features(const OrbFeatures& a, const OrbFeatures& b) {
  std::vector<Nearest> in_b(a.descriptors.size());
  std::vector<Nearest> in_a(b.descriptors.size());
  for (std::size_t i = 0; i < a.descriptors.size(); ++i) {
    for (std::size_t j = 0; j < b.descriptors.size(); ++j) {
      const int distance = hamming_distance(a.descriptors[i], b.descriptors[j]);
      in_b[i].see(j, distance);
      in_a[j].see(i, distance);
    }
  }
  std::vector<FeatureMatch> matches;
  for (std::size_t i = 0; i < in_b.size(); ++i) {
    if (in_b[i].clear() && in_a[in_b[i].index].index == i) matches.push_back({i, in_b[i].index});
  }
  return matches;
}

}  // namespace sparsight
