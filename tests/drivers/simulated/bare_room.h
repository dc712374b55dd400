#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "drivers/simulated/canvas.h"
#include "drivers/simulated/scene.h"
#include "drivers/simulated/scene_builder.h"
#include "drivers/simulated/simulated_rig.h"

namespace sparsight::testing {

// A room of 12 m by 8 m by 3 m with a column, all of which is made and lit within milliseconds.
inline simulated::Scene bare_room() {
  simulated::Scene scene;
  simulated::SceneBuilder build(scene, 1);
  simulated::Material blotched;
  std::vector<float> noise = simulated::cloud_noise(64, 4, 0.8F, 7);
  for (float& value : noise) value = 0.5F + 0.4F * value;
  blotched.pattern = scene.library.add(simulated::Texture(64, 64, noise));
  const int wall = scene.library.add(blotched);
  const Eigen::Vector3f x(12, 0, 0);
  const Eigen::Vector3f y(0, 8, 0);
  const Eigen::Vector3f z(0, 0, 3);
  const Eigen::Vector3f corner(-6, -4, 0);
  build.panel(corner, x, y, wall);
  build.panel(corner + z + y, x, -y, wall);
  build.panel(corner + y, x, z, wall);
  build.panel(corner + x, -x, z, wall);
  build.panel(corner, y, z, wall);
  build.panel(corner + x + y, -y, z, wall);
  build.column({0, 0, 0}, 0.4F, 3.0F, 12, wall);
  scene.light_spacing_m = 1.0F;
  scene.bounced_light = 1.5F;
  scene.walk.corners = {{-4, -2}, {4, -2}, {4, 2}, {-4, 2}};
  return scene;
}

inline SimulationOptions small_options(double seconds = 1.0) {
  SimulationOptions options;
  options.duration = std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
  options.width = 96;
  options.height = 72;
  options.light_detail = 0.1;
  return options;
}

struct SimulatedEvents {
  std::vector<RigEvent> all;
  std::vector<CameraFrame> frames;
  std::vector<LidarPacket> packets;
  std::vector<PositionPacket> positions;
  std::vector<Edge> exposure_edges;
  std::vector<Edge> pps_edges;
  std::vector<DeviceStateChange> changes;
};

inline SimulatedEvents gather_events(RigEventSource& rig) {
  SimulatedEvents events;
  while (std::optional<RigEvent> event = rig.next()) {
    if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&*event)) {
      events.frames.push_back(**frame);
    } else if (const auto* packet = std::get_if<LidarPacket>(&*event)) {
      events.packets.push_back(*packet);
    } else if (const auto* position = std::get_if<PositionPacket>(&*event)) {
      events.positions.push_back(*position);
    } else if (const auto* edge = std::get_if<Edge>(&*event)) {
      (edge->line == EdgeLine::kPps ? events.pps_edges : events.exposure_edges).push_back(*edge);
    } else {
      events.changes.push_back(std::get<DeviceStateChange>(*event));
    }
    events.all.push_back(std::move(*event));
  }
  return events;
}

inline SimulatedEvents events_in_bare_room(const SimulationOptions& options) {
  SimulatedRig rig(options, bare_room());
  return gather_events(rig);
}

}  // namespace sparsight::testing
