#include "slam/loop/place_image.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

TEST(PlaceImage, IsHalvedAsConfiguredWhileEnoughIsLeft) {
  EXPECT_EQ(place_image_level(1, 800), 1);
  EXPECT_EQ(place_image_level(1, 640), 1);
  EXPECT_EQ(place_image_level(1, 400), 0);
  EXPECT_EQ(place_image_level(2, 1241), 2);
  EXPECT_EQ(place_image_level(2, 800), 1);
  EXPECT_EQ(place_image_level(0, 100), 0);
}

}  // namespace
}  // namespace sparsight
