#include "drivers/simulated/light_baker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

namespace sparsight::simulated {
namespace {

constexpr int kDirections = 48;
constexpr float kLift = 0.004F;  // off the surface, so that rays do not meet it
constexpr float kLampReachM = 14.0F;
constexpr float kOpenM = 1.2F;  // walls this near take away two thirds of the bounced light

// Van der Corput's sequence in base 2.
float bit_reversed(std::uint32_t i) {
  float result = 0.0F;
  for (float half = 0.5F; i != 0; i >>= 1U, half *= 0.5F) {
    if ((i & 1U) != 0) result += half;
  }
  return result;
}

Eigen::Vector3f turned(const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f helper =
      std::abs(normal.z()) < 0.9F ? Eigen::Vector3f(0, 0, 1) : Eigen::Vector3f(1, 0, 0);
  const Eigen::Vector3f side = normal.cross(helper).normalized();
  return direction.x() * side + direction.y() * normal.cross(side) + direction.z() * normal;
}

// The mean of the neighbours that are known; places inside other bodies take it over as well, so
// that no dark rim shows around what stands before a wall.
std::vector<float> spread(const std::vector<float>& values, int columns, int rows) {
  std::vector<float> out(values.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      float sum = 0.0F;
      float weight = 0.0F;
      for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y) {
        for (int x = std::max(0, column - 1); x <= std::min(columns - 1, column + 1); ++x) {
          const float value = values[static_cast<std::size_t>(y * columns + x)];
          const float w = x == column && y == row ? 4.0F : 1.0F;
          if (value >= 0.0F) {
            sum += w * value;
            weight += w;
          }
        }
      }
      out[static_cast<std::size_t>(row * columns + column)] = weight > 0.0F ? sum / weight : -1.0F;
    }
  }
  return out;
}

}  // namespace

LightBaker::LightBaker(World& world) : world_(world) {
  for (std::size_t i = 0; i < world.frames_.size(); ++i) {
    const PanelFrame& frame = world.frames_[i];
    const Material& material = world.material_of(static_cast<std::uint32_t>(i));
    if (material.emission <= 0.0F) continue;
    lamps_.push_back({frame.origin, frame.right * frame.size.x(), frame.up * frame.size.y(),
                      frame.normal, material.emission * material.albedo * frame.size.prod()});
  }
  for (std::uint32_t i = 0; i < kDirections; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / kDirections;
    const float angle = 2.0F * static_cast<float>(M_PI) * bit_reversed(i);
    const float radius = std::sqrt(share);
    hemisphere_.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                             std::sqrt(1.0F - share));
  }
}

void LightBaker::bake() {
  // Every place is computed by itself: the result does not depend on who computes it.
  const std::size_t count = world_.frames_.size();
  const auto share = [this, count](std::size_t first) {
    for (std::size_t i = first; i < count; i += 2) bake_panel(i);
  };
  std::thread other(share, 1);
  share(0);
  other.join();
}

LightBaker::Place LightBaker::place(std::size_t index, int column, int row) const {
  const PanelFrame& frame = world_.frames_[index];
  const Panel& panel = world_.scene_.panels[index];
  // Off the rim, where another surface begins.
  const auto share = [](int i, int places, float size) {
    const float x = places > 1 ? static_cast<float>(i) / static_cast<float>(places - 1) : 0.5F;
    const float rim = std::min(0.2F, 0.02F / std::max(size, 0.01F));
    return std::clamp(x, rim, 1.0F - rim);
  };
  const float a = share(column, frame.light_columns, frame.size.x());
  const float b = share(row, frame.light_rows, frame.size.y());
  const Eigen::Vector3f normal =
      panel.round ? ((1 - a) * panel.left_normal + a * panel.right_normal).normalized()
                  : frame.normal;
  return {frame.origin + a * frame.size.x() * frame.right + b * frame.size.y() * frame.up +
              kLift * frame.normal,
          normal};
}

float LightBaker::from_lamps(const Place& place) const {
  constexpr std::array<std::array<float, 2>, 4> kSpots{
      {{0.18F, 0.3F}, {0.68F, 0.15F}, {0.35F, 0.85F}, {0.85F, 0.7F}}};
  float sum = 0.0F;
  for (const Lamp& lamp : lamps_) {
    if ((lamp.corner - place.at).squaredNorm() > kLampReachM * kLampReachM) continue;
    for (const auto& spot : kSpots) {
      const Eigen::Vector3f to = lamp.corner + spot[0] * lamp.right + spot[1] * lamp.up - place.at;
      const float distance2 = std::max(to.squaredNorm(), 0.04F);
      const float distance = std::sqrt(distance2);
      const float cosines = to.dot(place.normal) * -to.dot(lamp.normal) / distance2;
      if (to.dot(place.normal) <= 0.0F || cosines <= 0.0F) continue;
      if (world_.blocked({place.at, to / distance}, distance - 0.03F)) continue;
      sum += lamp.power * cosines / (4.0F * static_cast<float>(M_PI) * distance2);
    }
  }
  return sum;
}

float LightBaker::from_sun(const Place& place) const {
  const Daylight& light = world_.scene_.daylight;
  const Eigen::Vector3f sun = light.towards_sun.normalized();
  const float cosine = sun.dot(place.normal);
  if (light.sun <= 0.0F || cosine <= 0.0F) return 0.0F;
  float seen = 0.0F;
  for (const Eigen::Vector3f& d : {Eigen::Vector3f(1, 1, 0), Eigen::Vector3f(-1, 1, 1),
                                   Eigen::Vector3f(1, -1, -1), Eigen::Vector3f(-1, -1, 0)}) {
    if (!world_.blocked({place.at, (sun + 0.008F * d).normalized()}, 1e4F)) seen += 0.25F;
  }
  return light.sun * cosine * seen;
}

float LightBaker::from_around(const Place& place) const {
  const Scene& scene = world_.scene_;
  float sum = 0.0F;
  int inside = 0;
  for (const Eigen::Vector3f& d : hemisphere_) {
    const Eigen::Vector3f direction = turned(d, place.normal);
    const Hit hit = world_.cast({place.at, direction});
    if (!hit.any()) {
      sum += world_.sky_radiance(direction);
    } else {
      if (world_.frame(hit.panel).normal.dot(direction) > 0.0F && hit.distance < 1.0F) ++inside;
      sum += scene.bounced_light * (1.0F - std::exp(-hit.distance / kOpenM));
    }
  }
  return inside > kDirections / 2 ? -1.0F : sum / kDirections;
}

void LightBaker::bake_panel(std::size_t index) {
  const PanelFrame& frame = world_.frames_[index];
  const int columns = frame.light_columns;
  const int rows = frame.light_rows;
  std::vector<float> around;
  std::vector<float> direct;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Place at = place(index, column, row);
      around.push_back(from_around(at));
      direct.push_back(around.back() < 0.0F ? -1.0F : from_lamps(at) + from_sun(at));
    }
  }
  const auto unknown = [](float value) { return value < 0.0F; };
  around = spread(around, columns, rows);
  for (int round = 0; round < 4; ++round) {
    if (std::ranges::any_of(around, unknown)) around = spread(around, columns, rows);
    if (std::ranges::any_of(direct, unknown)) direct = spread(direct, columns, rows);
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    world_.lights_[frame.light + i] = std::max(around[i], 0.0F) + std::max(direct[i], 0.0F);
  }
}

}  // namespace sparsight::simulated
