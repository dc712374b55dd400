#include "tests/synthetic/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synthetic/lens.h"
#include "tests/synthetic/scene.h"

namespace sparsight::synthetic {
namespace {

Scene small(const char* name) {
  Scene scene = *make_scene(name);
  scene.resize(scene.rig.camera.width / 4, scene.rig.camera.height / 4);
  return scene;
}

// Grey differences between pixels of frame `a` and the places in frame `b` that show the same
// points, by the true poses and depths; points that do not move and are seen in both.
std::vector<double> warped_differences(const Scene& scene, std::size_t a, std::size_t b) {
  const CameraIntrinsics& camera = scene.rig.camera;
  const Eigen::Isometry3d T_world_a = scene.T_world_camera(scene.exposure_s(a));
  const Eigen::Isometry3d T_world_b = scene.T_world_camera(scene.exposure_s(b));
  const auto depth_a = render_depth(scene.world, camera, T_world_a, scene.exposure_s(a));
  const auto depth_b = render_depth(scene.world, camera, T_world_b, scene.exposure_s(b));
  const GreyImage image_a = scene.image(a);
  const GreyImage image_b = scene.image(b);
  std::vector<double> differences;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto index = static_cast<std::size_t>(v * camera.width + u);
      if (!std::isfinite(depth_a[index])) continue;
      const Eigen::Vector3d ray = pixel_direction(camera, Eigen::Vector2d(u, v));
      const Eigen::Vector3d p_b =
          T_world_b.inverse() * T_world_a * (ray * depth_a[index] / ray.z());
      const auto pixel = project(camera, p_b);
      if (!pixel) continue;
      const int u_b = static_cast<int>(std::lround(pixel->x()));
      const int v_b = static_cast<int>(std::lround(pixel->y()));
      if (u_b < 0 || v_b < 0 || u_b >= camera.width || v_b >= camera.height) continue;
      const double seen = depth_b[static_cast<std::size_t>(v_b * camera.width + u_b)];
      if (std::abs(seen - p_b.z()) > 0.05 * p_b.z()) continue;
      differences.push_back(std::abs(image_a.at(u, v) - image_b.at(u_b, v_b)));
    }
  }
  return differences;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

TEST(Renderer, ASurfaceKeepsItsGreyFromFrameToFrame) {
  for (const char* name : {"street", "corridor", "desk"}) {
    const auto differences = warped_differences(small(name), 10, 11);
    ASSERT_GT(differences.size(), 5000U) << name;
    EXPECT_LT(median(differences), 5.0) << name;
  }
}

TEST(Renderer, ImagesHaveTheContrastOfPhotographs) {
  for (const std::string& name : scene_names()) {
    const GreyImage image = small(name.c_str()).image(5);
    double sum = 0.0;
    double squares = 0.0;
    for (const std::uint8_t grey : image.pixels) {
      sum += grey;
      squares += grey * grey;
    }
    const double count = static_cast<double>(image.pixels.size());
    EXPECT_GT(sum / count, 40.0) << name;
    EXPECT_LT(sum / count, 200.0) << name;
    EXPECT_GT(std::sqrt(squares / count - sum * sum / count / count), 15.0) << name;
  }
}

TEST(Renderer, ThreadsDoNotChangeTheImage) {
  Scene scene = small("street");
  const GreyImage one = scene.image(4);
  scene.imager.threads = 3;
  EXPECT_EQ(scene.image(4).pixels, one.pixels);
}

TEST(Renderer, SensorNoiseHasTheSigmaAskedFor) {
  Scene scene = small("corridor");
  scene.imager.noise_grey = 0.0;
  const GreyImage clean = scene.image(4);
  scene.imager.noise_grey = 2.0;
  const GreyImage noisy = scene.image(4);
  double squares = 0.0;
  for (std::size_t i = 0; i < clean.pixels.size(); ++i) {
    const double difference = noisy.pixels[i] - clean.pixels[i];
    squares += difference * difference;
  }
  // Rounding to whole grey levels adds a sixth, once for each image a twelfth.
  EXPECT_NEAR(squares / static_cast<double>(clean.pixels.size()), 4.0 + 1.0 / 6.0, 0.25);
}

TEST(Renderer, BrightnessIsGainAndOffset) {
  Scene scene = small("desk");
  scene.imager.noise_grey = 0.0;
  const GreyImage plain = scene.image(4);
  scene.imager.brightness = [](double) { return Eigen::Vector2d(0.5, 10.0); };
  const GreyImage darker = scene.image(4);
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
    EXPECT_NEAR(darker.pixels[i], 0.5 * plain.pixels[i] + 10.0, 1.0);
  }
}

TEST(Renderer, ALongExposureBlursWhatMoves) {
  Scene scene = small("street");
  scene.imager.noise_grey = 0.0;
  const GreyImage sharp = scene.image(4);
  scene.imager.exposure_s = 0.05;
  scene.imager.sub_exposures = 4;
  const GreyImage blurred = scene.image(4);
  const auto roughness = [](const GreyImage& image) {
    double sum = 0.0;
    for (std::size_t i = 1; i < image.pixels.size(); ++i) {
      sum += std::abs(image.pixels[i] - image.pixels[i - 1]);
    }
    return sum;
  };
  EXPECT_LT(roughness(blurred), 0.9 * roughness(sharp));
}

}  // namespace
}  // namespace sparsight::synthetic
