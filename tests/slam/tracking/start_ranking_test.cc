#include "slam/tracking/start_ranking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/geometry/se3.h"
#include "slam/image/pyramid.h"
#include "slam/tracking/patch_set.h"
#include "tests/slam/analytic_image.h"
#include "tests/slam/tracking/counted_budget.h"

namespace sparsight {
namespace {

PatchSet numbered_patches(std::size_t patches) {
  PatchSet set;
  for (std::size_t i = 0; i < patches * kPatternSize; ++i) {
    const auto number = static_cast<float>(i / kPatternSize);
    set.x.push_back(number);
    set.y.push_back(number);
    set.z.push_back(1.0F + number);
    set.intensity.push_back(number);
    set.weight.push_back(1.0F);
  }
  set.patches = patches;
  return set;
}

PatchSet thinned(const PatchSet& patches, std::size_t wanted) {
  PatchSet out = numbered_patches(3);  // what was in it is gone
  thin(patches, wanted, out);
  return out;
}

TEST(Thinned, KeepsWholePatchesAtEvenSteps) {
  const PatchSet thin = thinned(numbered_patches(30), 10);
  ASSERT_EQ(thin.patches, 10U);
  for (std::size_t patch = 0; patch < thin.patches; ++patch) {
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      EXPECT_EQ(thin.x[patch * kPatternSize + i], static_cast<float>(3 * patch));
    }
  }
}

TEST(Thinned, IsPaddedToWholeBlocksWithoutWeight) {
  const PatchSet thin = thinned(numbered_patches(9), 3);
  ASSERT_EQ(thin.patches, 3U);
  EXPECT_EQ(thin.entries() % PatchSet::kBlock, 0U);
  for (std::size_t i = thin.patches * kPatternSize; i < thin.entries(); ++i) {
    EXPECT_EQ(thin.weight[i], 0.0F);
  }
  EXPECT_EQ(thin.z.size(), thin.entries());
  EXPECT_EQ(thin.weight.size(), thin.entries());
}

TEST(Thinned, LeavesASmallSetAndAnEmptyOneAsTheyAre) {
  EXPECT_EQ(thinned(numbered_patches(5), 100).patches, 5U);
  EXPECT_EQ(thinned(PatchSet{}, 100).patches, 0U);
}

// A textured wall 5 m ahead, seen twice from the same place.
struct Wall {
  Wall() {
    CameraIntrinsics c{.width = 160, .height = 120, .fx = 100.0, .fy = 100.0};
    c.cx = 79.5;
    c.cy = 59.5;
    camera = CameraModel(c);
    const ImagePyramid pyramid(image, 1);
    std::vector<SelectedPoint> points;
    for (int v = 15; v < 110; v += 9) {
      for (int u = 15; u < 150; u += 9) {
        const Eigen::Vector2d pixel(u, v);
        points.push_back({.p_camera = (5.0 * camera.unproject(pixel)).cast<float>(),
                          .pixel = pixel.cast<float>()});
      }
    }
    patches = make_patches(pyramid, 0, camera, points, 0.0);
  }

  std::vector<RankedStart> rank(const std::vector<Eigen::Isometry3d>& T_camera_keyframe,
                                SearchBudget* budget = nullptr) const {
    std::vector<Alignment> starts(T_camera_keyframe.size());
    for (std::size_t i = 0; i < starts.size(); ++i) {
      starts[i].T_camera_keyframe = T_camera_keyframe[i];
    }
    AlignmentWorkspace workspace;
    std::vector<RankedStart> ranked;
    rank_starts(starts, patches, image, camera, 0.2, 30.0, {}, workspace, ranked, budget);
    return ranked;
  }

  GreyImage image = analytic_image(160, 120, [](double u, double v) {
    return 128.0 + 50.0 * std::sin(0.21 * u + 0.0007 * u * v) + 40.0 * std::sin(0.27 * v + 1.0);
  });
  CameraModel camera{CameraIntrinsics{}};
  PatchSet patches;
};

Eigen::Isometry3d turned(double rad) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(rad, Eigen::Vector3d::UnitY()));
}

TEST(RankStarts, PutsTheStartThatLeadsHomeFirst) {
  const std::vector<RankedStart> ranked = Wall().rank({turned(0.45), turned(0.02)});
  ASSERT_EQ(ranked.size(), 2U);
  EXPECT_GT(ranked[0].found_share, 0.95);
  EXPECT_LT(log_se3(ranked[0].at.T_camera_keyframe).norm(), 0.02);
  EXPECT_LT(ranked[1].found_share, ranked[0].found_share);
}

TEST(RankStarts, LeavesOutStartsThatSeeNothing) {
  EXPECT_TRUE(Wall().rank({turned(M_PI)}).empty());
  EXPECT_TRUE(Wall().rank({}).empty());
}

TEST(RankStarts, TriesTheFirstAsFarAsTheBudgetGoes) {
  CountedBudget two(2, 0);
  const std::vector<RankedStart> ranked =
      Wall().rank({turned(0.45), turned(0.02), turned(0.0)}, &two);
  ASSERT_EQ(ranked.size(), 2U);
  EXPECT_EQ(two.asked(SearchBudget::Step::kRank), 3);
  CountedBudget none(0, 0);
  EXPECT_TRUE(Wall().rank({turned(0.0)}, &none).empty());
}

}  // namespace
}  // namespace sparsight
