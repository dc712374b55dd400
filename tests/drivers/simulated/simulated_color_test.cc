#include <gtest/gtest.h>

#include <array>

#include "drivers/simulated/tint.h"
#include "tests/drivers/simulated/bare_room.h"

namespace sparsight {
namespace {

using simulated::bayer_channel;
using simulated::tint;
using testing::small_options;

std::vector<CameraFrame> frames_of(bool color, const Eigen::Vector3f& wall_tint) {
  SimulationOptions options = small_options(0.2);
  options.color = color;
  simulated::Scene scene = testing::bare_room();
  for (simulated::Material& material : scene.library.materials) material.tint = wall_tint;
  SimulatedRig rig(options, std::move(scene));
  return testing::gather_events(rig).frames;
}

std::array<double, 3> means_of(const CameraFrame& frame) {
  std::array<double, 3> sums{};
  std::array<double, 3> counts{};
  for (int v = 0; v < frame.height; ++v) {
    for (int u = 0; u < frame.width; ++u) {
      const auto channel = static_cast<std::size_t>(bayer_channel(u, v));
      sums[channel] += frame.bytes[static_cast<std::size_t>(v * frame.stride_bytes + u)];
      ++counts[channel];
    }
  }
  return {sums[0] / counts[0], sums[1] / counts[1], sums[2] / counts[2]};
}

TEST(Tint, LeavesTheLumaAloneAndMovesTheColor) {
  for (float hue = -360.0F; hue < 720.0F; hue += 15.0F) {
    for (const float saturation : {0.0F, 0.4F, 1.2F}) {
      const Eigen::Vector3f t = tint(hue, saturation);
      EXPECT_NEAR(t.dot(Eigen::Vector3f(0.299F, 0.587F, 0.114F)), 1.0F, 1e-5F);
      EXPECT_GT(t.minCoeff(), 0.0F);
    }
  }
  EXPECT_GT(tint(0.0F, 0.5F).x(), 1.2F);
  EXPECT_LT(tint(0.0F, 0.5F).z(), 0.95F);
  EXPECT_GT(tint(240.0F, 0.5F).z(), 1.3F);
  EXPECT_TRUE(tint(77.0F, 0.0F).isOnes(1e-6F));
}

TEST(SimulatedColor, OfGreyThingsIsGrey) {
  const auto grey = frames_of(false, Eigen::Vector3f::Ones());
  const auto color = frames_of(true, Eigen::Vector3f::Ones());
  ASSERT_EQ(grey.size(), color.size());
  ASSERT_GE(grey.size(), 5U);
  EXPECT_EQ(grey[0].format, PixelFormat::kGrey8);
  EXPECT_EQ(color[0].format, PixelFormat::kBayerRggb8);
  for (std::size_t i = 0; i < grey.size(); ++i) EXPECT_EQ(grey[i].bytes, color[i].bytes);
}

TEST(SimulatedColor, IsThatOfTheMaterialAndUnseenInGrey) {
  const Eigen::Vector3f green = tint(120.0F, 0.5F);
  EXPECT_EQ(frames_of(false, green)[3].bytes, frames_of(false, Eigen::Vector3f::Ones())[3].bytes);
  const auto means = means_of(frames_of(true, green)[3]);
  EXPECT_NEAR(means[0] / means[1], green[0] / green[1], 0.03);
  EXPECT_NEAR(means[2] / means[1], green[2] / green[1], 0.03);
}

TEST(SimulatedColor, NeedsEvenSides) {
  SimulationOptions options = small_options();
  options.color = true;
  EXPECT_TRUE(check(options));
  options.width = 97;
  EXPECT_FALSE(check(options));
  EXPECT_EQ(simulated_rig_config(small_options()).camera.format, "GREY");
  EXPECT_EQ(simulated_rig_config(options).camera.format, "RGGB");
}

}  // namespace
}  // namespace sparsight
