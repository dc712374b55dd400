#include "drivers/simulated/simulated_rig.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "drivers/simulated/edge_stream.h"
#include "drivers/simulated/frame_stream.h"
#include "drivers/simulated/packet_stream.h"
#include "drivers/simulated/scenes.h"
#include "drivers/simulated/walk.h"
#include "drivers/simulated/world.h"

namespace sparsight {
namespace {

using namespace simulated;

CameraIntrinsics intrinsics(const SimulationOptions& options) {
  CameraIntrinsics camera;
  camera.width = options.width;
  camera.height = options.height;
  camera.fx = camera.fy = 0.525 * options.width;  // 87 degrees from left to right
  camera.cx = 0.5 * (options.width - 1) + 0.0031 * options.width;
  camera.cy = 0.5 * (options.height - 1) - 0.0043 * options.height;
  if (options.lens == SimulatedLens::kMild) {
    camera.k1 = -0.048;
    camera.k2 = 0.011;
    camera.p1 = 0.0004;
    camera.p2 = -0.0003;
  }
  return camera;
}

// The camera is mounted below the LiDAR, a little ahead, and not quite straight.
Eigen::Isometry3d camera_mount() {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Vector3d tilt_rad(0.006, -0.009, 0.004);
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
  T_camera_lidar.linear() =
      Eigen::AngleAxisd(tilt_rad.norm(), tilt_rad.normalized()).toRotationMatrix() * axes;
  const Eigen::Vector3d p_lidar_camera(0.062, 0.008, -0.094);
  T_camera_lidar.translation() = -(T_camera_lidar.linear() * p_lidar_camera);
  return T_camera_lidar;
}

std::vector<HostTime> exposures(const SimulationOptions& options, const CameraClock& clock) {
  std::vector<HostTime> times;
  for (std::uint64_t number = 0;; ++number) {
    const FrameTimes frame = clock.frame(number);
    if (frame.exposed + options.exposure > options.duration) return times;
    times.push_back(options.start + frame.middle);
  }
}

}  // namespace

RigConfig simulated_rig_config(const SimulationOptions& options) {
  RigConfig config;
  config.name = "simulated";
  config.calibration = {intrinsics(options), camera_mount()};
  config.camera.device = "simulated";
  config.camera.width = options.width;
  config.camera.height = options.height;
  config.camera.rate_hz = options.rate_hz;
  config.camera.format = options.color ? "RGGB" : "GREY";
  config.camera.exposure = options.exposure;
  config.lidar.sensor_address = "";
  config.lidar.rpm = 600;
  config.lidar.return_mode = options.return_mode;
  config.trigger.chip = "simulated";
  if (options.pps) config.trigger.pps_line = 1;
  return config;
}

struct SimulatedRig::Parts {
  Parts(const SimulationOptions& o, Scene scene)
      : options(o),
        config(simulated_rig_config(o)),
        world(std::move(scene)),
        walk(std::make_shared<const Walk>(world.scene().walk, o.seed, o.faults.carried)),
        faults(o.faults, o.seed),
        camera_clock(o),
        pulses(o.seed),
        lidar_clock(options, faults, pulses),
        scanner(world, lidar_clock, pulses, options,
                [this](Elapsed at) { return walk->lidar_pose(to_seconds(at)); }),
        truth(walk, o.start, config.calibration.T_camera_lidar, exposures(o, camera_clock)),
        streams{std::make_unique<StateStream>(options),
                std::make_unique<EdgeStream>(options, camera_clock, pulses, faults),
                std::make_unique<PacketStream>(scanner, lidar_clock, faults, options),
                std::make_unique<FrameStream>(FrameContext{options, config.calibration, world,
                                                           *walk, camera_clock, faults})} {}

  SimulationOptions options;
  RigConfig config;
  World world;
  std::shared_ptr<const Walk> walk;
  FaultPlan faults;
  CameraClock camera_clock;
  PulseClock pulses;
  LidarClock lidar_clock;
  LidarScanner scanner;
  SimulatedTruth truth;
  std::array<std::unique_ptr<EventStream>, 4> streams;  // last: their threads use the rest
};

SimulatedRig::SimulatedRig(const SimulationOptions& options)
    : SimulatedRig(options, make_scene(options)) {}

SimulatedRig::SimulatedRig(const SimulationOptions& options, Scene scene)
    : parts_(std::make_unique<Parts>(options, std::move(scene))) {}

SimulatedRig::~SimulatedRig() = default;

std::optional<RigEvent> SimulatedRig::next() {
  EventStream* first = nullptr;
  HostTime earliest = HostTime::max();
  for (const std::unique_ptr<EventStream>& stream : parts_->streams) {
    const std::optional<HostTime> arrival = stream->peek();
    if (arrival && *arrival < earliest) {
      earliest = *arrival;
      first = stream.get();
    }
  }
  if (first == nullptr) return std::nullopt;
  return first->take();
}

const RigConfig& SimulatedRig::rig_config() const { return parts_->config; }

const SimulatedTruth& SimulatedRig::ground_truth() const { return parts_->truth; }

const SimulationOptions& SimulatedRig::options() const { return parts_->options; }

std::vector<float> SimulatedRig::camera_depth(HostTime at) const {
  return FrameRenderer(parts_->world, parts_->config.calibration.camera)
      .depth(parts_->truth.camera_pose(at));
}

std::optional<double> SimulatedRig::distance(const Eigen::Vector3d& p_world,
                                             const Eigen::Vector3d& direction_world) const {
  const Hit hit =
      parts_->world.cast({p_world.cast<float>(), direction_world.normalized().cast<float>()});
  if (!hit.any()) return std::nullopt;
  return hit.distance;
}

Result<void> check(const SimulationOptions& options) {
  const auto bad = [](const char* option, const char* range) {
    return fail(ErrorCode::kOutOfRange, fmt::format("simulation: {} must be {}", option, range));
  };
  if (options.duration <= std::chrono::nanoseconds(0) || options.duration > std::chrono::hours(4)) {
    return bad("the duration", "more than nothing and at most four hours");
  }
  if (options.width < 32 || options.width > 4096 || options.height < 32 || options.height > 4096) {
    return bad("the frame's width and height", "32 to 4096 pixels");
  }
  if (options.color && (options.width % 2 != 0 || options.height % 2 != 0)) {
    return bad("the width and height of colour frames", "even");
  }
  if (!(options.rate_hz >= 1.0 && options.rate_hz <= 120.0)) {
    return bad("the frame rate", "1 to 120 Hz");
  }
  if (!(options.light_detail >= 0.05 && options.light_detail <= 4.0)) {
    return bad("the detail of light", "0.05 to 4");
  }
  if (options.exposure.count() < 10 || to_seconds(options.exposure) > 0.5 / options.rate_hz) {
    return bad("the exposure", "10 microseconds to half a frame period");
  }
  for (const double share : {options.faults.lost_edges, options.faults.lost_frames,
                             options.faults.lost_packets, options.exposure_drift}) {
    if (!(share >= 0.0 && share <= 1.0)) return bad("a share", "from 0 to 1");
  }
  return {};
}

}  // namespace sparsight
