#include "drivers/simulated/world.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "drivers/simulated/light_baker.h"

namespace sparsight::simulated {
namespace {

int grid_places(float length, float spacing) {
  // Leaves and other small things are lit evenly.
  if (length < 0.6F * spacing) return 1;
  return std::clamp(static_cast<int>(std::lround(length / spacing)) + 1, 2, 1024);
}

}  // namespace

RTCRayHit embree_ray(const Ray& ray, float nearest, float farthest) {
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x();
  query.ray.org_y = ray.origin.y();
  query.ray.org_z = ray.origin.z();
  query.ray.dir_x = ray.direction.x();
  query.ray.dir_y = ray.direction.y();
  query.ray.dir_z = ray.direction.z();
  query.ray.tnear = nearest;
  query.ray.tfar = farthest;
  query.ray.mask = 0xffffffffU;
  query.hit.primID = kNoPanel;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

World::World(Scene scene) : scene_(std::move(scene)) {
  build_frames();
  build_tree();
  LightBaker(*this).bake();
}

void World::build_frames() {
  for (const Panel& panel : scene_.panels) {
    PanelFrame frame;
    frame.normal = panel.normal();
    frame.right = (panel.corners[1] - panel.corners[0]).normalized();
    frame.up = frame.normal.cross(frame.right);
    Eigen::Vector2f low = Eigen::Vector2f::Constant(1e9F);
    Eigen::Vector2f high = -low;
    for (const Eigen::Vector3f& corner : panel.corners) {
      const Eigen::Vector3f from = corner - panel.corners[0];
      const Eigen::Vector2f at(from.dot(frame.right), from.dot(frame.up));
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    frame.origin = panel.corners[0] + low.x() * frame.right + low.y() * frame.up;
    frame.size = high - low;
    frame.offset = panel.offset;
    frame.material = panel.material;
    frame.light = static_cast<std::uint32_t>(lights_.size());
    frame.light_columns = grid_places(frame.size.x(), scene_.light_spacing_m);
    frame.light_rows = grid_places(frame.size.y(), scene_.light_spacing_m);
    lights_.resize(lights_.size() + static_cast<std::size_t>(frame.light_columns) *
                                        static_cast<std::size_t>(frame.light_rows));
    frames_.push_back(frame);
  }
}

void World::build_tree() {
  // One thread builds, or the tree and with it the order of equal hits would depend on timing.
  device_.reset(rtcNewDevice("threads=1,set_affinity=0"));
  tree_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(tree_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree_.get(), RTC_BUILD_QUALITY_HIGH);
  RTCGeometry quads = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
  const std::size_t count = scene_.panels.size();
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * count));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), count));
  for (std::size_t i = 0; i < 4 * count; ++i) {
    const Eigen::Vector3f& corner = scene_.panels[i / 4].corners[i % 4];
    std::copy_n(corner.data(), 3, vertices + 3 * i);
    indices[i] = static_cast<std::uint32_t>(i);
  }
  rtcCommitGeometry(quads);
  rtcAttachGeometry(tree_.get(), quads);
  rtcReleaseGeometry(quads);
  rtcCommitScene(tree_.get());
}

Hit World::cast(const Ray& ray, float nearest, float farthest) const {
  RTCRayHit query = embree_ray(ray, nearest, farthest);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(tree_.get(), &context, &query);
  return {query.hit.primID, query.ray.tfar};
}

void World::cast_together(std::vector<RTCRayHit>& rays) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1M(tree_.get(), &context, rays.data(), static_cast<unsigned>(rays.size()),
                 sizeof(RTCRayHit));
}

bool World::blocked(const Ray& ray, float farthest) const {
  RTCRay query = embree_ray(ray, 0.0F, farthest).ray;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(tree_.get(), &context, &query);
  return query.tfar < 0.0F;
}

float World::light_at(const PanelFrame& frame, const Eigen::Vector2f& at) const {
  const float* light = &lights_[frame.light];
  const auto place = [](float position, float size, int places, int& low, int& high) {
    const float x = std::clamp(position / size, 0.0F, 1.0F) * static_cast<float>(places - 1);
    low = std::min(static_cast<int>(x), std::max(0, places - 2));
    high = std::min(low + 1, places - 1);
    return x - static_cast<float>(low);
  };
  int left = 0;
  int right = 0;
  int low = 0;
  int high = 0;
  const float a = place(at.x(), frame.size.x(), frame.light_columns, left, right);
  const float b = place(at.y(), frame.size.y(), frame.light_rows, low, high);
  const int row = low * frame.light_columns;
  const int next = high * frame.light_columns;
  return (light[row + left] * (1 - a) + light[row + right] * a) * (1 - b) +
         (light[next + left] * (1 - a) + light[next + right] * a) * b;
}

// Where the ray of the next pixel meets the plane of the surface (Igehy 1999, eq. 10 and 12).
float World::radiance(std::uint32_t panel, const Eigen::Vector3f& origin, const Sighting& sighting,
                      float distance) const {
  const PanelFrame& frame = frames_[panel];
  const Material& material = material_of(panel);
  const Eigen::Vector3f at = origin + distance * sighting.direction - frame.origin;
  const Eigen::Vector2f place(at.dot(frame.right), at.dot(frame.up));
  const float along = sighting.direction.dot(frame.normal);
  const float inverse = 1.0F / (std::abs(along) > 1e-6F ? along : 1e-6F);
  const auto moved = [&](const Eigen::Vector3f& change) -> Eigen::Vector2f {
    const Eigen::Vector3f step =
        distance * (change - sighting.direction * (change.dot(frame.normal) * inverse));
    return {step.dot(frame.right), step.dot(frame.up)};
  };
  const Footprint footprint{moved(sighting.direction_right), moved(sighting.direction_down)};
  const float albedo = scene_.library.albedo(material, place, frame.offset, footprint);
  return albedo * (light_at(frame, place) + material.emission);
}

float World::sky_radiance(const Eigen::Vector3f& direction) const {
  const Daylight& light = scene_.daylight;
  if (light.sky <= 0.0F) return 0.0F;
  const Eigen::Vector3f towards = direction.normalized();
  const float up = std::max(towards.z(), 0.0F);
  float radiance = light.sky * (0.85F + 0.4F * (1.0F - up) * (1.0F - up));
  if (light.clouds != kNoTexture && up > 0.02F) {
    // A layer of clouds 1 km up, fading towards the horizon.
    const Eigen::Vector2f at = towards.head<2>() / (up + 0.12F) * 0.18F;
    const float cloud =
        scene_.library.textures[static_cast<std::size_t>(light.clouds)].sample(at, {});
    const float share = std::clamp((cloud - (1.0F - light.cloud_cover)) * 3.0F, 0.0F, 1.0F);
    radiance *= 1.0F + 0.35F * share * std::min(1.0F, 4.0F * up);
  }
  return radiance;
}

bool World::seamless(std::uint32_t a, std::uint32_t b) const {
  if (a == b) return true;
  if (a == kNoPanel || b == kNoPanel) return false;
  const PanelFrame& one = frames_[a];
  const PanelFrame& other = frames_[b];
  return one.material == other.material && one.normal.dot(other.normal) > 0.999F &&
         std::abs((other.origin - one.origin).dot(one.normal)) < 0.002F;
}

}  // namespace sparsight::simulated
