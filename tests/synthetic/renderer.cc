#include "tests/synthetic/renderer.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "tests/synthetic/lens.h"
#include "tests/synthetic/noise.h"
#include "tests/synthetic/random.h"

namespace sparsight::synthetic {
namespace {

constexpr double kFarthest = 2000.0;
constexpr std::uint32_t kSky = 0xffffffffU;

struct Sample {
  double grey = 0.0;
  std::uint32_t surface = kSky;
};

double sky_grey(const Eigen::Vector3d& direction) {
  const double up = std::max(direction.z(), 0.0);
  const Eigen::Vector2d dome = direction.head<2>() / (0.15 + up);
  return 205.0 - 45.0 * std::sqrt(up) + 8.0 * OctaveNoise{2.0, 0.2, 0.5, 5}(dome, {0.05, 0.05});
}

// The pixel's footprint is an ellipse, long where the surface is seen at a grazing angle; samples
// along its long axis keep the short axis sharp.
double surface_grey(const Hit& hit, const Ray& ray, double pixel_angle) {
  constexpr double kMaxSamples = 8.0;
  const double minor = hit.distance * pixel_angle;
  const double facing = std::max(std::abs(ray.direction.dot(hit.normal)), 0.02);
  const double samples = std::clamp(std::ceil(1.0 / facing), 1.0, kMaxSamples);
  const double major = minor / facing;
  Eigen::Vector2d along(ray.direction.dot(hit.tangent_u), ray.direction.dot(hit.tangent_v));
  along = along.norm() > 1e-9 ? Eigen::Vector2d(along.normalized()) : Eigen::Vector2d(1.0, 0.0);
  const double length = std::max(major / samples, minor);
  const Footprint footprint{std::abs(along.x()) * length + std::abs(along.y()) * minor,
                            std::abs(along.y()) * length + std::abs(along.x()) * minor};
  double sum = 0.0;
  for (double i = 0.5; i < samples; i += 1.0) {
    sum += hit.material->grey(hit.uv + along * major * (i / samples - 0.5), footprint);
  }
  return sum / samples;
}

class FrameRenderer {
 public:
  FrameRenderer(const World& world, const CameraIntrinsics& camera,
                const Eigen::Isometry3d& T_world_camera, double seconds)
      : light_(world.light),
        camera_(camera),
        T_world_camera_(T_world_camera),
        snapshot_(world, seconds) {}

  Sample sample(double u, double v) const {
    const Ray ray{T_world_camera_.translation(),
                  T_world_camera_.linear() * pixel_direction(camera_, {u, v})};
    const auto hit = snapshot_.intersect(ray, kFarthest);
    if (!hit) return {light_.sky ? sky_grey(ray.direction) : 0.0, kSky};
    const double lit = std::max(0.0, hit->normal.dot(light_.towards));
    const double shade = light_.ambient + light_.directed * lit;
    return {shade * surface_grey(*hit, ray, 1.0 / camera_.fx), hit->surface};
  }

  double depth(double u, double v) const {
    const Eigen::Vector3d direction = pixel_direction(camera_, {u, v});
    const auto hit = snapshot_.intersect(
        {T_world_camera_.translation(), T_world_camera_.linear() * direction}, kFarthest);
    return hit ? hit->distance * direction.z() : std::numeric_limits<double>::infinity();
  }

 private:
  const Light& light_;
  const CameraIntrinsics& camera_;
  Eigen::Isometry3d T_world_camera_;
  Snapshot snapshot_;
};

void for_rows(int height, int threads, const std::function<void(int row)>& work) {
  std::vector<std::jthread> workers;
  for (int t = 0; t < threads; ++t) {
    workers.emplace_back([=, &work] {
      for (int row = t; row < height; row += threads) work(row);
    });
  }
}

// Pixels whose neighbours see another face are sampled four times more: outlines without stairs.
std::vector<double> radiance(const FrameRenderer& frame, int width, int height, int threads) {
  std::vector<Sample> samples(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto at = [&](int u, int v) -> Sample& {
    return samples[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(u)];
  };
  for_rows(height, threads, [&](int v) {
    for (int u = 0; u < width; ++u) at(u, v) = frame.sample(u, v);
  });
  std::vector<double> result(samples.size());
  for_rows(height, threads, [&](int v) {
    for (int u = 0; u < width; ++u) {
      const Sample& centre = at(u, v);
      double grey = centre.grey;
      if (at(std::max(u - 1, 0), v).surface != centre.surface ||
          at(std::min(u + 1, width - 1), v).surface != centre.surface ||
          at(u, std::max(v - 1, 0)).surface != centre.surface ||
          at(u, std::min(v + 1, height - 1)).surface != centre.surface) {
        grey = (frame.sample(u - 0.25, v - 0.25).grey + frame.sample(u + 0.25, v - 0.25).grey +
                frame.sample(u - 0.25, v + 0.25).grey + frame.sample(u + 0.25, v + 0.25).grey) /
               4.0;
      }
      result[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(u)] = grey;
    }
  });
  return result;
}

GreyImage develop(const std::vector<double>& light, const CameraIntrinsics& camera, double seconds,
                  const Imager& imager) {
  GreyImage image{camera.width, camera.height, std::vector<std::uint8_t>(light.size())};
  const Eigen::Vector2d brightness =
      imager.brightness ? imager.brightness(seconds) : Eigen::Vector2d(1.0, 0.0);
  const double corner = Eigen::Vector2d(camera.width, camera.height).squaredNorm() / 4.0;
  const std::uint64_t seed = hash(imager.seed ^ static_cast<std::uint64_t>(seconds * 1e6));
  for (std::size_t i = 0; i < light.size(); ++i) {
    const auto width = static_cast<std::size_t>(camera.width);
    const Eigen::Vector2d off(static_cast<double>(i % width) - camera.width / 2.0,
                              static_cast<double>(i / width) - camera.height / 2.0);
    const double gain = brightness.x() * (1.0 - imager.vignetting * off.squaredNorm() / corner);
    const double noise = imager.noise_grey * normal(hash(seed + i));
    image.pixels[i] = static_cast<std::uint8_t>(
        std::clamp(std::lround(gain * light[i] + brightness.y() + noise), 0L, 255L));
  }
  return image;
}

}  // namespace

GreyImage render(const World& world, const CameraIntrinsics& camera,
                 const std::function<Eigen::Isometry3d(double)>& T_world_camera, double seconds,
                 const Imager& imager) {
  std::vector<double> sum(static_cast<std::size_t>(camera.width) *
                          static_cast<std::size_t>(camera.height));
  for (int i = 0; i < imager.sub_exposures; ++i) {
    const double at =
        seconds + imager.exposure_s * ((i + 0.5) / static_cast<double>(imager.sub_exposures) - 0.5);
    const FrameRenderer frame(world, camera, T_world_camera(at), at);
    const auto light = radiance(frame, camera.width, camera.height, imager.threads);
    for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += light[p] / imager.sub_exposures;
  }
  return develop(sum, camera, seconds, imager);
}

std::vector<double> render_depth(const World& world, const CameraIntrinsics& camera,
                                 const Eigen::Isometry3d& T_world_camera, double seconds) {
  const FrameRenderer frame(world, camera, T_world_camera, seconds);
  std::vector<double> depth;
  depth.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) depth.push_back(frame.depth(u, v));
  }
  return depth;
}

}  // namespace sparsight::synthetic
