#include "slam/tracking/patch_agreement.h"

#include <gtest/gtest.h>

#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

PatchAgreement agreement(const SineRoom& room, const PatchSet& patches, const GreyImage& image,
                         const Eigen::Isometry3d& T_camera_keyframe,
                         const Brightness& brightness = {}) {
  Linearization l;
  linearize(patches, image, room.camera(), T_camera_keyframe, brightness, l);
  return patch_agreement(patches, l, brightness);
}

class PatchAgreementTest : public testing::Test {
 protected:
  const SineRoom room_{};
  const Eigen::Isometry3d T_origin_ = Eigen::Isometry3d::Identity();
  const PatchSet patches_ = room_.keyframe(0, T_origin_).patches[0];
};

TEST_F(PatchAgreementTest, IsAllAtTheTruePose) {
  const PatchAgreement same = agreement(room_, patches_, room_.image(T_origin_), T_origin_);
  EXPECT_EQ(same.found_share, 1.0);
  EXPECT_EQ(same.visible_patches, static_cast<int>(patches_.patches));
  const Eigen::Isometry3d T = pose(0.02, -0.05, 0.03, 0.1, 0.05, -0.3);
  EXPECT_GT(agreement(room_, patches_, room_.image(T.inverse()), T).found_share, 0.97);
}

TEST_F(PatchAgreementTest, DoesNotCareForBrightnessKnownOrUnknown) {
  const Brightness darker{0.6, 20.0};
  const GreyImage image = room_.image(T_origin_, darker);
  EXPECT_GT(agreement(room_, patches_, image, T_origin_, darker).found_share, 0.97);
  EXPECT_GT(agreement(room_, patches_, image, T_origin_).found_share, 0.97);
}

TEST_F(PatchAgreementTest, IsLittleInAnotherRoomAndNothingInTheNegative) {
  SineRoom other = room_;
  other.pattern = 4;
  EXPECT_LT(agreement(room_, patches_, other.image(T_origin_), T_origin_).found_share, 0.4);
  const GreyImage negative = room_.image(T_origin_, {-1.0, 255.0});
  EXPECT_EQ(agreement(room_, patches_, negative, T_origin_).found_share, 0.0);
}

TEST_F(PatchAgreementTest, IsNothingInAnImageWithoutTexture) {
  const GreyImage grey = analytic_image(160, 120, [](double, double) { return 90.0; });
  EXPECT_EQ(agreement(room_, patches_, grey, T_origin_).found_share, 0.0);
}

TEST_F(PatchAgreementTest, NamesThePatchesThatAreNotThereAtAll) {
  const auto missing = [&](const GreyImage& image) {
    Linearization l;
    linearize(patches_, image, room_.camera(), T_origin_, {}, l);
    return missing_patches(patches_, l, {}, 0.2);
  };
  EXPECT_TRUE(missing(room_.image(T_origin_)).empty());
  EXPECT_TRUE(missing(room_.image(T_origin_, {0.6, 20.0})).empty());
  EXPECT_GT(missing(room_.image(T_origin_, {-1.0, 255.0})).size(), patches_.patches * 2 / 3);
}

TEST_F(PatchAgreementTest, CountsThePatchesWhoseCentreIsSeen) {
  const Eigen::Isometry3d T = pose(0.0, 0.5, 0.0, 0.0, 0.0, 0.0);
  const PatchAgreement turned = agreement(room_, patches_, room_.image(T.inverse()), T);
  int expected = 0;
  for (std::size_t patch = 0; patch < patches_.patches; ++patch) {
    const std::size_t i = patch * kPatternSize;
    Eigen::Vector2d pixel;
    expected += room_.camera().project(
                    T * Eigen::Vector3d(patches_.x[i], patches_.y[i], patches_.z[i]), pixel) &&
                room_.camera().contains(pixel, 1.0);
  }
  EXPECT_NEAR(turned.visible_patches, expected, 2);
  EXPECT_LT(turned.visible_patches, static_cast<int>(patches_.patches) * 3 / 4);
}

TEST_F(PatchAgreementTest, LeavesPatchesWithoutTextureOut) {
  // A keyframe most of which is blank: the rest decides.
  GreyImage half = room_.image(T_origin_);
  for (int v = 0; v < half.height; ++v) {
    for (int u = 0; u < half.width * 3 / 4; ++u) {
      half.pixels[static_cast<std::size_t>(v * half.width + u)] = 100;
    }
  }
  const PatchSet patches = room_.keyframe(0, T_origin_, half).patches[0];
  EXPECT_GT(agreement(room_, patches, room_.image(T_origin_), T_origin_).found_share, 0.97);
}

TEST_F(PatchAgreementTest, IsNothingForAKeyframeTakenInTheDark) {
  const GreyImage black = analytic_image(160, 120, [](double, double) { return 0.0; });
  const PatchSet patches = room_.keyframe(0, T_origin_, black).patches[0];
  EXPECT_EQ(agreement(room_, patches, black, T_origin_).found_share, 0.0);
}

}  // namespace
}  // namespace sparsight
