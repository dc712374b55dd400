#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/simulated/scene.h"
#include "drivers/simulated/tint.h"

namespace sparsight::simulated {

inline constexpr std::uint32_t kNoPanel = RTC_INVALID_GEOMETRY_ID;

struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;  // distances are in multiples of its length
};

struct Hit {
  std::uint32_t panel = kNoPanel;
  float distance = 0.0F;

  bool any() const { return panel != kNoPanel; }
};

// What is looked up for every pixel about a panel.
struct PanelFrame {
  Eigen::Vector3f origin;
  Eigen::Vector3f right;  // unit; coordinates on the surface are metres along these two
  Eigen::Vector3f up;
  Eigen::Vector3f normal;
  Eigen::Vector2f size;
  Eigen::Vector2f offset;
  int material = 0;
  // Light on the surface: a grid of places over its whole size, in World's store.
  std::uint32_t light = 0;
  int light_columns = 1;
  int light_rows = 1;
};

struct Sighting {
  Eigen::Vector3f direction;        // as of the ray
  Eigen::Vector3f direction_right;  // of the pixel to the right minus this one's
  Eigen::Vector3f direction_down;
};

// The scene as rays meet it, lit once when it is made. Thread-safe after that.
class World {
 public:
  explicit World(Scene scene);

  Hit cast(const Ray& ray, float nearest = 0.0F, float farthest = 1e6F) const;
  // Many rays from one place that go almost the same way; the result stands in `rays`.
  void cast_together(std::vector<RTCRayHit>& rays) const;
  bool blocked(const Ray& ray, float farthest) const;

  // Light that comes from a panel towards the viewer at `origin`, averaged over a pixel.
  float radiance(std::uint32_t panel, const Eigen::Vector3f& origin, const Sighting& sighting,
                 float distance) const;
  float sky_radiance(const Eigen::Vector3f& direction) const;
  // Of the panel, or of the sky.
  const Eigen::Vector3f& tint_of(std::uint32_t panel) const {
    return panel == kNoPanel ? sky_tint_ : material_of(panel).tint;
  }

  const Scene& scene() const { return scene_; }
  const PanelFrame& frame(std::uint32_t panel) const { return frames_[panel]; }
  const Material& material_of(std::uint32_t panel) const {
    return scene_.library.materials[static_cast<std::size_t>(frames_[panel].material)];
  }
  // Two panels that continue each other, so that no edge lies between their pictures.
  bool seamless(std::uint32_t a, std::uint32_t b) const;

 private:
  friend class LightBaker;
  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  void build_frames();
  void build_tree();
  float light_at(const PanelFrame& frame, const Eigen::Vector2f& at) const;

  Scene scene_;
  const Eigen::Vector3f sky_tint_ = tint(212.0F, 0.22F);
  std::vector<PanelFrame> frames_;
  std::vector<float> lights_;
  std::unique_ptr<RTCDeviceTy, Release> device_;
  std::unique_ptr<RTCSceneTy, Release> tree_;
};

RTCRayHit embree_ray(const Ray& ray, float nearest, float farthest);

}  // namespace sparsight::simulated
