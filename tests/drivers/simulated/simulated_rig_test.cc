#include "drivers/simulated/simulated_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "drivers/simulated/lens.h"
#include "drivers/vlp16/vlp16_geometry.h"
#include "drivers/vlp16/wire_format.h"
#include "tests/drivers/simulated/bare_room.h"

namespace sparsight {
namespace {

using testing::bare_room;
using testing::events_in_bare_room;
using testing::gather_events;
using testing::SimulatedEvents;
using testing::small_options;

struct CastReturn {
  Eigen::Vector3d origin_world;
  Eigen::Vector3d direction_world;
  double range = 0.0;

  Eigen::Vector3d p_world() const { return origin_world + range * direction_world; }
};

// What a packet says, put into the world by the truth at each firing. The first firing is known to
// the network's delay, during which a hand does not move by a millimetre.
std::vector<CastReturn> returns_of(const LidarPacket& packet, const SimulatedTruth& truth) {
  const auto wire = wire::from_bytes<wire::DataPacket>(packet.payload);
  const HostTime first = packet.arrival - kVlp16PacketInterval - std::chrono::microseconds(180);
  std::vector<CastReturn> returns;
  for (std::size_t block = 0; block < wire.blocks.size(); ++block) {
    for (std::size_t k = 0; k < 32; ++k) {
      const wire::Measurement measured = wire.blocks[block].measurements[k];
      if (measured.distance_2mm == 0) continue;
      const auto since = firing_offset(k / 16, k % 16);
      const double azimuth =
          (wire.blocks[block].azimuth_centideg * 0.01 + 3600.0 * to_seconds(since)) * M_PI / 180;
      const LaserPlacement& laser = kVlp16LaserTable[k % 16];
      const double elevation = laser.elevation_deg * M_PI / 180;
      const Eigen::Isometry3d T_world_lidar =
          truth.lidar_pose(first + firing_offset(2 * block + k / 16, k % 16));
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      -std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      returns.push_back({T_world_lidar * Eigen::Vector3d(0, 0, laser.vertical_offset_mm * 1e-3),
                         T_world_lidar.linear() * direction,
                         measured.distance_2mm * kVlp16DistanceUnitM});
    }
  }
  return returns;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 2));
  return values[values.size() / 2];
}

TEST(SimulatedRig, DeliversAtTheRatesOfTheDevices) {
  const SimulatedEvents events = events_in_bare_room(small_options());
  EXPECT_NEAR(static_cast<double>(events.frames.size()), 30.0, 1.0);
  EXPECT_NEAR(static_cast<double>(events.packets.size()), 753.5, 1.5);
  EXPECT_NEAR(static_cast<double>(events.positions.size()), 53.8, 1.5);
  EXPECT_NEAR(static_cast<double>(events.exposure_edges.size()), 60.0, 2.0);
  EXPECT_GE(events.pps_edges.size(), 1U);
}

TEST(SimulatedRig, DeliversInTheOrderOfArrival) {
  const SimulatedEvents events = events_in_bare_room(small_options());
  EXPECT_TRUE(std::ranges::is_sorted(events.all, {}, arrival_of));
}

std::string bytes_of(const SimulatedEvents& events) {
  std::ostringstream text;
  for (const RigEvent& event : events.all) {
    text << event.index() << ' ' << arrival_of(event).time_since_epoch().count() << ' ';
  }
  for (const CameraFrame& frame : events.frames) {
    text << frame.sequence << frame.driver_time.time_since_epoch().count();
    text.write(reinterpret_cast<const char*>(frame.bytes.data()), std::ssize(frame.bytes));
  }
  for (const LidarPacket& packet : events.packets) {
    text.write(reinterpret_cast<const char*>(packet.payload.data()), std::ssize(packet.payload));
  }
  for (const PositionPacket& packet : events.positions) {
    text.write(reinterpret_cast<const char*>(packet.payload.data()), std::ssize(packet.payload));
  }
  return text.str();
}

TEST(SimulatedRig, GivesTheSameBytesForTheSameSeed) {
  SimulationOptions options = small_options(0.3);
  const std::string once = bytes_of(events_in_bare_room(options));
  EXPECT_EQ(once, bytes_of(events_in_bare_room(options)));
  options.seed = 2;
  EXPECT_NE(once, bytes_of(events_in_bare_room(options)));
}

TEST(SimulatedRig, FiresFromWhereTheSensorIsAtEachFiring) {
  // Under way and turning: a pose a packet off would be millimetres off.
  const SimulationOptions options = small_options(3.5);
  SimulatedRig rig(options, bare_room());
  std::vector<double> errors;
  std::size_t firings = 0;
  int number = 0;
  while (const std::optional<RigEvent> event = rig.next()) {
    const auto* packet = std::get_if<LidarPacket>(&*event);
    if (packet == nullptr || ++number % 23 != 0) continue;
    firings += 384;
    for (const CastReturn& found : returns_of(*packet, rig.ground_truth())) {
      const auto distance = rig.distance(found.origin_world, found.direction_world);
      if (distance) errors.push_back(found.range - *distance);
    }
  }
  ASSERT_GT(errors.size(), firings * 97 / 100);
  const auto within = std::ranges::count_if(errors, [](double e) { return std::abs(e) < 0.033; });
  EXPECT_GT(static_cast<double>(within), 0.985 * static_cast<double>(errors.size()));
  EXPECT_NEAR(median(errors), 0.0, 0.001);
  for (double& error : errors) error = std::abs(error);
  EXPECT_NEAR(median(errors), 0.6745 * options.range_noise_m, 0.0015);  // of a normal distribution
}

TEST(SimulatedRig, ShowsInTheImageWhatTheLidarMeasures) {
  SimulatedRig rig(small_options(0.5), bare_room());
  const SimulatedTruth& truth = rig.ground_truth();
  const CameraIntrinsics camera = rig.rig_config().calibration.camera;
  const HostTime exposure = truth.exposures()[6];
  const std::vector<float> depth = rig.camera_depth(exposure);
  const Eigen::Isometry3d T_camera_world = truth.camera_pose(exposure).inverse();
  std::vector<double> errors;
  while (const std::optional<RigEvent> event = rig.next()) {
    const auto* packet = std::get_if<LidarPacket>(&*event);
    if (packet == nullptr) continue;
    for (const CastReturn& found : returns_of(*packet, truth)) {
      const Eigen::Vector3d p_camera = T_camera_world * found.p_world();
      if (p_camera.z() < 0.3) continue;
      const Eigen::Vector2d pixel = simulated::project(camera, p_camera.head<2>() / p_camera.z());
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
      errors.push_back(
          std::abs(depth[static_cast<std::size_t>(v * camera.width + u)] - p_camera.z()));
    }
  }
  ASSERT_GT(errors.size(), 1000U);
  EXPECT_LT(median(errors), 0.02);
}

TEST(SimulatedRig, MarksEveryExposureWithTwoEdges) {
  SimulatedRig rig(small_options(), bare_room());
  const std::vector<HostTime> exposures = rig.ground_truth().exposures();
  const SimulatedEvents events = gather_events(rig);
  ASSERT_EQ(events.exposure_edges.size(), 2 * exposures.size());
  ASSERT_EQ(events.frames.size(), exposures.size());
  for (std::size_t i = 0; i < exposures.size(); ++i) {
    const Edge& begin = events.exposure_edges[2 * i];
    const Edge& end = events.exposure_edges[2 * i + 1];
    EXPECT_TRUE(begin.rising);
    EXPECT_FALSE(end.rising);
    const auto middle = begin.time + (end.time - begin.time) / 2;
    EXPECT_LT(std::abs(to_seconds(middle - exposures[i])), 100e-6);
    const double late = to_seconds(events.frames[i].driver_time - end.time);
    EXPECT_GT(late, 0.010);  // readout
    EXPECT_LT(late, 0.016);
    EXPECT_GT(events.frames[i].arrival, events.frames[i].driver_time);
  }
}

TEST(SimulatedRig, SeesABrightRoomWithTexture) {
  const SimulatedEvents events = events_in_bare_room(small_options(0.2));
  const std::vector<std::uint8_t>& bytes = events.frames.front().bytes;
  ASSERT_EQ(bytes.size(), 96U * 72U);
  double sum = 0.0;
  double squares = 0.0;
  for (const std::uint8_t byte : bytes) {
    sum += byte;
    squares += static_cast<double>(byte) * byte;
  }
  const double mean = sum / static_cast<double>(bytes.size());
  EXPECT_GT(mean, 30.0);
  EXPECT_LT(mean, 220.0);
  EXPECT_GT(std::sqrt(squares / static_cast<double>(bytes.size()) - mean * mean), 8.0);
}

TEST(SimulatedRig, TellsUtcInPositionPacketsWhilePpsIsLocked) {
  const SimulatedEvents events = events_in_bare_room(small_options(0.3));
  for (const PositionPacket& packet : events.positions) {
    const auto wire = wire::from_bytes<wire::PositionPacket>(packet.payload);
    EXPECT_EQ(wire.pps_state, 2);
    EXPECT_EQ(std::string_view(wire.nmea.data(), 7), "$GPRMC,");
  }
}

TEST(SimulatedRig, WithoutPpsHasNoPulseAndSaysSo) {
  SimulationOptions options = small_options();
  options.pps = false;
  const SimulatedEvents events = events_in_bare_room(options);
  EXPECT_TRUE(events.pps_edges.empty());
  ASSERT_FALSE(events.positions.empty());
  for (const PositionPacket& packet : events.positions) {
    EXPECT_EQ(wire::from_bytes<wire::PositionPacket>(packet.payload).pps_state, 0);
  }
}

TEST(SimulatedRig, WritesItsTruthAsTum) {
  SimulatedRig rig(small_options(0.2), bare_room());
  std::istringstream lines(rig.ground_truth().tum());
  std::size_t count = 0;
  for (double t, x, y, z, qx, qy, qz, qw; lines >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
       ++count) {
    const HostTime exposure = rig.ground_truth().exposures().at(count);
    EXPECT_NEAR(t, to_seconds(exposure.time_since_epoch()), 1e-6);
    const Eigen::Isometry3d T_world_camera = rig.ground_truth().camera_pose(exposure);
    EXPECT_LT((T_world_camera.translation() - Eigen::Vector3d(x, y, z)).norm(), 2e-9);
    EXPECT_NEAR(
        std::abs(
            Eigen::Quaterniond(qw, qx, qy, qz).dot(Eigen::Quaterniond(T_world_camera.linear()))),
        1.0, 1e-8);
  }
  EXPECT_EQ(count, rig.ground_truth().exposures().size());
  EXPECT_TRUE(lines.eof());
}

TEST(SimulatedRig, RefusesWhatItCannotSimulate) {
  EXPECT_TRUE(check(SimulationOptions{}));
  SimulationOptions options;
  options.exposure = std::chrono::milliseconds(30);
  EXPECT_FALSE(check(options));
  options = {};
  options.width = 5;
  EXPECT_FALSE(check(options));
  options = {};
  options.faults.lost_edges = NAN;
  EXPECT_FALSE(check(options));
}

}  // namespace
}  // namespace sparsight
