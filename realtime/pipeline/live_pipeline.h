#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/calibration.h"
#include "hal/camera.h"
#include "hal/lidar.h"
#include "hal/trigger_line.h"
#include "realtime/pipeline/frame_record.h"
#include "realtime/pipeline/live_outputs.h"
#include "realtime/pipeline/live_shared.h"
#include "realtime/pipeline/live_status.h"
#include "realtime/sync/synchronizer.h"
#include "slam/odometry_config.h"

namespace sparsight {

struct LiveDevices {
  std::shared_ptr<Camera> camera;
  std::shared_ptr<Lidar> lidar;
  std::shared_ptr<TriggerLine> trigger;
  std::unique_ptr<LidarDecoder> decoder;
  JpegDecoder jpeg;
};

struct LiveConfig {
  double rate_hz = 30.0;           // of the camera's trigger
  bool realtime = true;            // asks for SCHED_FIFO; without the privilege it runs as ever
  bool odometry = true;            // false: nothing is tracked, only recorded
  std::vector<int> tracking_cpus;  // where tracking may run; anywhere if none is given
  std::size_t frames_in_flight = 8;
  int fewer_window_iterations = 4;       // when the window has to be shortened
  std::function<void(LiveStage)> probe;  // see LiveShared
};

// The threads of the rig: three devices, synchronisation, tracking, window, journal, background
// (docs/architecture.md has the table). Thread-bound: one thread starts, looks and stops.
class LivePipeline {
 public:
  LivePipeline(LiveDevices devices, const RigCalibration& calibration,
               const OdometryConfig& odometry, const SyncConfig& sync, LiveOutputs outputs,
               const LiveConfig& config);
  ~LivePipeline();
  LivePipeline(const LivePipeline&) = delete;
  LivePipeline& operator=(const LivePipeline&) = delete;

  void start();
  // To be called about ten times a second: it is also what decides on work to be left out.
  LiveStatus look();
  // What the system refused, in words; each once.
  std::vector<std::string> remarks();
  // The stages that have not advanced since the call before.
  std::vector<std::string> standing_still();
  // All devices have played to their end; never of live ones.
  bool ended() const;
  // Stops the devices, then lets each stage finish what it was given. Idempotent.
  void stop();

  // After stop(): one pose per frame, each at its keyframe's final pose.
  std::vector<TrajectoryPose> trajectory() const;
  // The same with the keyframes elsewhere, by their sequence.
  std::vector<TrajectoryPose> trajectory(
      const std::map<std::uint64_t, Eigen::Isometry3d>& T_world_keyframes) const;
  const CameraIntrinsics& camera() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace sparsight
