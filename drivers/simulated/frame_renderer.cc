#include "drivers/simulated/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "drivers/simulated/lens.h"

namespace sparsight::simulated {
namespace {

constexpr int kTile = 8;
constexpr float kNearM = 0.02F;
constexpr std::size_t kLooks = 8;
constexpr float kBrightestGrey = 320.0F;  // well saturated

// Eight places in a pixel, no two in one row or column of eighths.
constexpr std::array<std::array<float, 2>, kLooks> kPlaces{{{-0.4375F, -0.0625F},
                                                            {-0.3125F, 0.3125F},
                                                            {-0.1875F, -0.3125F},
                                                            {-0.0625F, 0.1875F},
                                                            {0.0625F, -0.4375F},
                                                            {0.1875F, 0.4375F},
                                                            {0.3125F, -0.1875F},
                                                            {0.4375F, 0.0625F}}};

}  // namespace

FrameRenderer::FrameRenderer(const World& world, const CameraIntrinsics& camera, bool color)
    : world_(world),
      color_(color),
      width_(camera.width),
      height_(camera.height),
      brightest_(kBrightestGrey / world.scene().exposure_gain),
      step_(static_cast<float>(1.0 / camera.fx), static_cast<float>(1.0 / camera.fy)) {
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      rays_.emplace_back(unproject(camera, {u, v}).cast<float>());
    }
  }
}

std::vector<Hit> FrameRenderer::first_hits(const View& view) const {
  std::vector<Hit> hits(rays_.size());
  std::vector<RTCRayHit> tile;
  std::vector<int> pixels;
  for (int top = 0; top < height_; top += kTile) {
    for (int left = 0; left < width_; left += kTile) {
      tile.clear();
      pixels.clear();
      for (int v = top; v < std::min(top + kTile, height_); ++v) {
        for (int u = left; u < std::min(left + kTile, width_); ++u) {
          pixels.push_back(v * width_ + u);
          const Eigen::Vector3f direction =
              view.R * rays_[static_cast<std::size_t>(pixels.back())].homogeneous();
          tile.push_back(embree_ray({view.origin, direction}, kNearM, 1e6F));
        }
      }
      world_.cast_together(tile);
      for (std::size_t i = 0; i < tile.size(); ++i) {
        hits[static_cast<std::size_t>(pixels[i])] = {tile[i].hit.primID, tile[i].ray.tfar};
      }
    }
  }
  return hits;
}

std::vector<int> FrameRenderer::edge_pixels(const std::vector<Hit>& hits) const {
  std::vector<char> edge(hits.size(), 0);
  const auto compare = [&](int a, int b) {
    if (!world_.seamless(hits[static_cast<std::size_t>(a)].panel,
                         hits[static_cast<std::size_t>(b)].panel)) {
      edge[static_cast<std::size_t>(a)] = edge[static_cast<std::size_t>(b)] = 1;
    }
  };
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const int at = v * width_ + u;
      if (u + 1 < width_) compare(at, at + 1);
      if (v + 1 < height_) compare(at, at + width_);
    }
  }
  std::vector<int> pixels;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    if (edge[i] != 0) pixels.push_back(static_cast<int>(i));
  }
  return pixels;
}

float FrameRenderer::light_of(const View& view, const Hit& hit, const Eigen::Vector2f& on_plane,
                              float pixel) const {
  const Eigen::Vector3f direction = view.R * on_plane.homogeneous();
  if (!hit.any()) return world_.sky_radiance(direction);
  const Sighting sighting{direction, pixel * step_.x() * view.R.col(0),
                          pixel * step_.y() * view.R.col(1)};
  return world_.radiance(hit.panel, view.origin, sighting, hit.distance);
}

// Of the light, what the pixel's filter lets through.
float FrameRenderer::share_of(const Hit& hit, std::size_t pixel) const {
  if (!color_) return 1.0F;
  const int at = static_cast<int>(pixel);
  return world_.tint_of(hit.panel)[bayer_channel(at % width_, at / width_)];
}

void FrameRenderer::refine(const View& view, const std::vector<int>& pixels,
                           std::vector<float>& light) const {
  constexpr std::size_t kBatch = 8;
  std::vector<RTCRayHit> looks;
  const auto place = [&](std::size_t pixel, std::size_t look) -> Eigen::Vector2f {
    return rays_[pixel] + Eigen::Vector2f(kPlaces[look][0], kPlaces[look][1]).cwiseProduct(step_);
  };
  for (std::size_t first = 0; first < pixels.size(); first += kBatch) {
    const std::size_t last = std::min(first + kBatch, pixels.size());
    looks.clear();
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t look = 0; look < kLooks; ++look) {
        const Eigen::Vector3f direction =
            view.R * place(static_cast<std::size_t>(pixels[i]), look).homogeneous();
        looks.push_back(embree_ray({view.origin, direction}, kNearM, 1e6F));
      }
    }
    world_.cast_together(looks);
    for (std::size_t i = first; i < last; ++i) {
      const auto pixel = static_cast<std::size_t>(pixels[i]);
      float sum = 0.0F;
      for (std::size_t look = 0; look < kLooks; ++look) {
        const RTCRayHit& found = looks[(i - first) * kLooks + look];
        // A lamp in a share of the pixel must not outshine the rest, or its edge is jagged.
        const Hit hit{found.hit.primID, found.ray.tfar};
        sum += std::min(brightest_, light_of(view, hit, place(pixel, look), 0.5F)) *
               share_of(hit, pixel);
      }
      light[pixel] = sum / kLooks;
    }
  }
}

std::vector<float> FrameRenderer::render(const Eigen::Isometry3d& T_world_camera) const {
  const View view{T_world_camera.linear().cast<float>(),
                  T_world_camera.translation().cast<float>()};
  const std::vector<Hit> hits = first_hits(view);
  const std::vector<int> edges = edge_pixels(hits);
  std::vector<float> light(hits.size());
  std::size_t next_edge = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (next_edge < edges.size() && edges[next_edge] == static_cast<int>(i)) {
      ++next_edge;  // refined below
    } else {
      light[i] = light_of(view, hits[i], rays_[i], 1.0F) * share_of(hits[i], i);
    }
  }
  refine(view, edges, light);
  return light;
}

std::vector<float> FrameRenderer::depth(const Eigen::Isometry3d& T_world_camera) const {
  const View view{T_world_camera.linear().cast<float>(),
                  T_world_camera.translation().cast<float>()};
  std::vector<float> depth;
  for (const Hit& hit : first_hits(view)) {
    depth.push_back(hit.any() ? hit.distance : std::numeric_limits<float>::infinity());
  }
  return depth;
}

}  // namespace sparsight::simulated
