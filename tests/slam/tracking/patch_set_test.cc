#include "slam/tracking/patch_set.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/slam/analytic_image.h"

namespace sparsight {
namespace {

const CameraIntrinsics kIntrinsics{128, 96, 100.0, 110.0, 63.2, 47.9, -0.2, 0.05, 0.001, 0.0, 0.0};

GreyImage slope_image() {
  return analytic_image(128, 96, [](double u, double v) { return u + 1.25 * v; });
}

SelectedPoint point_at(double u, double v, double depth) {
  const Eigen::Vector3d p = depth * CameraModel(kIntrinsics).unproject({u, v});
  return {.p_camera = p.cast<float>(), .pixel = Eigen::Vector2d(u, v).cast<float>()};
}

PatchSet patches_of(const std::vector<SelectedPoint>& points, int level = 0,
                    double gradient_weight_constant = 0.0) {
  return make_patches(ImagePyramid(slope_image(), 3), level, CameraModel(kIntrinsics), points,
                      gradient_weight_constant);
}

Eigen::Vector3d p_of(const PatchSet& set, std::size_t entry) {
  return {set.x[entry], set.y[entry], set.z[entry]};
}

Eigen::Vector2d pixel_of(const PatchSet& set, std::size_t entry, int level) {
  Eigen::Vector2d pixel(-1.0, -1.0);
  EXPECT_TRUE(CameraModel(kIntrinsics).at_level(level).project(p_of(set, entry), pixel));
  return pixel;
}

TEST(PatchSet, PadsItsEntriesToWholeBlocksThatCountForNothing) {
  const PatchSet set = patches_of({point_at(40, 40, 5), point_at(60, 50, 5), point_at(80, 40, 5)});
  EXPECT_EQ(set.patches, 3U);
  ASSERT_EQ(set.entries(), 32U);
  for (const auto* column : {&set.x, &set.y, &set.z, &set.intensity, &set.weight}) {
    EXPECT_EQ(column->size(), 32U);
  }
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(set.weight[i], 1.0F);
  for (std::size_t i = 24; i < 32; ++i) EXPECT_EQ(set.weight[i], 0.0F);
  EXPECT_EQ(patches_of({}).entries(), 0U);
}

TEST(PatchSet, SpreadsThePatternOnTheRaysOfItsPixels) {
  for (const int level : {0, 1, 2}) {
    const PatchSet set = patches_of({point_at(40.3, 41.6, 5.0)}, level);
    const Eigen::Vector2d centre = pixel_of(set, 0, level);
    const double scale = std::exp2(level);
    EXPECT_LT(
        (centre - Eigen::Vector2d((40.3 + 0.5) / scale - 0.5, (41.6 + 0.5) / scale - 0.5)).norm(),
        1e-5);
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      const Eigen::Vector2d offset(kPattern[i].u, kPattern[i].v);
      EXPECT_LT((pixel_of(set, i, level) - centre - offset).norm(), 1e-3);
      EXPECT_NEAR(set.z[i], 5.0F, 1e-5F) << "the depth of its centre";
    }
  }
}

TEST(PatchSet, RemembersTheGreyValuesOfItsPixels) {
  const PatchSet set = patches_of({point_at(40.3, 41.6, 5.0)});
  for (std::size_t i = 0; i < kPatternSize; ++i) {
    const Eigen::Vector2d pixel = pixel_of(set, i, 0);
    // Rounding to whole grey levels is part of the image.
    EXPECT_NEAR(set.intensity[i], pixel.x() + 1.25 * pixel.y(), 0.51);
  }
}

TEST(PatchSet, LaysThePatternOntoASlantedPlane) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.8, 1.0).normalized();
  const Eigen::Vector3d ray = CameraModel(kIntrinsics).unproject({63.2, 47.9});
  SelectedPoint point = point_at(63.2, 47.9, 4.0 / normal.dot(ray));
  // At the principal point the lens does not distort: normalised coordinates are pixels over f.
  point.inverse_depth_slope =
      Eigen::Vector2d(normal.x() / 100.0 / 4.0, normal.y() / 110.0 / 4.0).cast<float>();
  for (const int level : {0, 2}) {
    const PatchSet set = patches_of({point}, level);
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      EXPECT_NEAR(normal.dot(p_of(set, i)), 4.0, 2e-3) << "level " << level << ", entry " << i;
    }
  }
}

TEST(PatchSet, WeighsAPatchAsItsPoint) {
  SelectedPoint stranger = point_at(40.0, 40.0, 5.0);
  stranger.weight = 0.25F;
  for (const int level : {0, 1}) {
    const PatchSet set = patches_of({stranger, point_at(80.0, 40.0, 5.0)}, level);
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      EXPECT_EQ(set.weight[i], 0.25F);
      EXPECT_EQ(set.weight[kPatternSize + i], 1.0F);
    }
  }
}

TEST(PatchSet, GivesNoWeightOutsideTheImage) {
  // At 2.5 px from the left border the pattern's leftmost pixel stands at 0.5: it has no gradient.
  const PatchSet set = patches_of({point_at(2.5, 40.0, 5.0)});
  for (std::size_t i = 0; i < kPatternSize; ++i) {
    EXPECT_EQ(set.weight[i], kPattern[i].u == -2 ? 0.0F : 1.0F) << i;
  }
}

TEST(PatchSet, GivesNoWeightToAPointThatCannotBeSeen) {
  SelectedPoint behind = point_at(40.0, 40.0, 5.0);
  behind.p_camera.z() = -5.0F;
  SelectedPoint unknown = point_at(40.0, 40.0, 5.0);
  unknown.p_camera.x() = std::numeric_limits<float>::quiet_NaN();
  SelectedPoint grazing = point_at(40.0, 40.0, 5.0);
  grazing.inverse_depth_slope = {0.15F, 0.0F};  // beyond the horizon two pixels to the left
  const PatchSet set = patches_of({behind, unknown, grazing});
  for (std::size_t i = 0; i < 2 * kPatternSize; ++i) EXPECT_EQ(set.weight[i], 0.0F);
  for (std::size_t i = 0; i < kPatternSize; ++i) {
    EXPECT_EQ(set.weight[2 * kPatternSize + i], kPattern[i].u == -2 ? 0.0F : 1.0F) << i;
  }
}

// c^2 / (c^2 + grad I^2) with c = 3 and a gradient of (1, 1): 9 / 11.
TEST(PatchSet, TrustsStrongGradientsLessIfTold) {
  const PatchSet set = make_patches(
      ImagePyramid(analytic_image(128, 96, [](double u, double v) { return u + v; }), 1), 0,
      CameraModel(kIntrinsics), {point_at(40.0, 40.0, 5.0)}, 3.0);
  for (std::size_t i = 0; i < kPatternSize; ++i) EXPECT_NEAR(set.weight[i], 9.0 / 11.0, 1e-4);
}

}  // namespace
}  // namespace sparsight
