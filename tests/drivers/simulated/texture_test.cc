#include "drivers/simulated/texture.h"

#include <gtest/gtest.h>

namespace sparsight::simulated {
namespace {

Texture chequered(int size) {
  std::vector<float> values;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) values.push_back((x + y) % 2 != 0 ? 1.0F : 0.0F);
  }
  return {size, size, values};
}

TEST(Texture, ShowsItsTexelsFromNear) {
  const Texture texture = chequered(8);
  EXPECT_NEAR(texture.sample({0.5F / 8, 0.5F / 8}, {}), 0.0F, 1e-3F);
  EXPECT_NEAR(texture.sample({1.5F / 8, 0.5F / 8}, {}), 1.0F, 1e-3F);
  EXPECT_NEAR(texture.sample({1.0F / 8, 0.5F / 8}, {}), 0.5F, 1e-2F);
}

TEST(Texture, RepeatsInBothDirections) {
  const Texture texture = chequered(8);
  for (const float shift : {-3.0F, -1.0F, 1.0F, 5.0F}) {
    EXPECT_NEAR(texture.sample({0.3F + shift, 0.7F - shift}, {}), texture.sample({0.3F, 0.7F}, {}),
                1e-3F);
  }
}

TEST(Texture, AveragesFromAfarInsteadOfAliasing) {
  const Texture texture = chequered(64);
  const Footprint wide{{4.0F / 64, 0.0F}, {0.0F, 4.0F / 64}};
  for (float x = 0.0F; x < 1.0F; x += 0.013F) {
    EXPECT_NEAR(texture.sample({x, 0.4F * x}, wide), 0.5F, 0.02F) << x;
    EXPECT_NEAR(texture.sample_soft({x, 0.4F * x}, wide), 0.5F, 0.02F) << x;
  }
}

TEST(Texture, StaysSharpAcrossALongFootprint) {
  // Lines along x: a footprint long in x and short in y must not mix them.
  std::vector<float> values;
  for (int y = 0; y < 64; ++y) values.insert(values.end(), 64, y % 8 < 4 ? 1.0F : 0.0F);
  const Texture lines(64, 64, values);
  const Footprint grazing{{4.0F / 64, 0.0F}, {0.0F, 1.0F / 64}};
  EXPECT_GT(lines.sample({0.5F, 2.0F / 64}, grazing), 0.9F);
  EXPECT_LT(lines.sample({0.5F, 6.0F / 64}, grazing), 0.1F);
}

}  // namespace
}  // namespace sparsight::simulated
