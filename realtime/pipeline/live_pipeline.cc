#include "realtime/pipeline/live_pipeline.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "realtime/executor/interrupt_threads.h"
#include "realtime/executor/loop_clock.h"
#include "realtime/pipeline/background_runner.h"
#include "realtime/pipeline/device_stage.h"
#include "realtime/pipeline/journal_runner.h"
#include "realtime/pipeline/sync_runner.h"
#include "realtime/pipeline/tracking_runner.h"
#include "realtime/pipeline/window_runner.h"
#include "slam/tracking_stage.h"
#include "slam/window_stage.h"

namespace sparsight {
namespace {

// SCHED_FIFO, each above what it feeds (docs/architecture.md).
constexpr int kTriggerInterruptPriority = 85;
constexpr int kTriggerPriority = 80;
constexpr int kLidarInterruptPriority = 75;
constexpr int kLidarPriority = 70;
constexpr int kCameraInterruptPriority = 67;
constexpr int kCameraPriority = 65;
constexpr int kSyncPriority = 60;
constexpr int kTrackingPriority = 40;

// Who has the lines, by the GPIO driver (drivers/gpio/libgpiod_calls.cc): its interrupts' name.
constexpr const char* kTriggerInterrupt = "sparsight";

// Two seconds and more of each device.
constexpr std::size_t kCameraEvents = 64;
constexpr std::size_t kLidarEvents = 2048;
constexpr std::size_t kTriggerEvents = 256;

constexpr std::chrono::nanoseconds kBlindAfter{500'000'000};

ThreadSettings settings(const char* name, const LiveConfig& config, int priority) {
  ThreadSettings result{.name = name};
  if (config.realtime && priority > 0) result.fifo_priority = priority;
  return result;
}

ThreadSettings tracking_settings(const LiveConfig& config) {
  ThreadSettings result = settings("tracking", config, kTrackingPriority);
  result.cpus = config.tracking_cpus;
  return result;
}

}  // namespace

struct LivePipeline::Parts {
  Parts(LiveDevices devices, const RigCalibration& calibration, const OdometryConfig& odometry,
        const SyncConfig& sync, LiveOutputs given_outputs, const LiveConfig& given)
      : config(given),
        outputs(std::move(given_outputs)),
        shared(config.frames_in_flight),
        camera(fed_device(std::move(devices.camera), kCameraInterruptPriority), kCameraEvents,
               settings("camera", config, kCameraPriority), remarks),
        lidar(fed_device(std::move(devices.lidar), kLidarInterruptPriority), kLidarEvents,
              settings("lidar", config, kLidarPriority), remarks),
        trigger(trigger_device(std::move(devices.trigger)), kTriggerEvents,
                settings("trigger", config, kTriggerPriority), remarks),
        tracking(calibration, odometry),
        window(calibration, odometry),
        sync_runner({&trigger.to_sync(), &lidar.to_sync(), &camera.to_sync()},
                    std::make_unique<Synchronizer>(calibration, sync, std::move(devices.decoder),
                                                   std::move(devices.jpeg)),
                    shared, clock),
        tracking_runner(tracking, period(), shared, clock),
        window_runner(window, config.fewer_window_iterations, shared, clock),
        journal_runner({&trigger.to_recorder(), &lidar.to_recorder(), &camera.to_recorder()},
                       outputs, shared, clock),
        background_runner(outputs, shared, clock),
        sync_thread(settings("sync", config, kSyncPriority), remarks),
        tracking_thread(tracking_settings(config), remarks),
        window_thread(settings("window", config, 0), remarks),
        journal_thread(settings("journal", config, 0), remarks),
        background_thread(settings("background", config, 0), remarks) {
    shared.probe = config.probe;
    shared.track = config.odometry;
    for (LiveFrame& frame : shared.frames) {
      tracking.prepare(frame.tracked);
      shared.free_from_tracking.producer().try_push(&frame);
    }
  }

  // Requesting a line has the kernel make a thread for its interrupt.
  DeviceStage::Device trigger_device(std::shared_ptr<TriggerLine> line) {
    return fed_by([] { return Interrupts{.names = {kTriggerInterrupt}}; },
                  stage_device(std::move(line)), kTriggerInterruptPriority);
  }
  template <typename D>
  DeviceStage::Device fed_device(std::shared_ptr<D> device, int priority) {
    return fed_by([device] { return interrupts_behind(device->system_folder()); },
                  stage_device(device), priority);
  }
  // Whenever it has begun to stream: it may have come back as another device.
  DeviceStage::Device fed_by(std::function<Interrupts()> interrupts, DeviceStage::Device device,
                             int priority) {
    if (!config.realtime) return device;
    device.streams = [this, interrupts = std::move(interrupts), priority] {
      const auto refused = raise_interrupt_threads(interrupts(), priority);
      if (refused) remarks.add(*refused);
    };
    return device;
  }
  std::chrono::nanoseconds period() const {
    return std::chrono::nanoseconds(std::llround(1e9 / config.rate_hz));
  }
  void watch();
  OverloadSigns signs();
  LiveState state(const LiveStatus& status) const;
  void count_work(LiveStatus& status) const;

  const LiveConfig config;
  const LiveOutputs outputs;
  MonotonicClock clock;
  SetupRemarks remarks;
  LiveShared shared;
  DeviceStage camera;
  DeviceStage lidar;
  DeviceStage trigger;
  TrackingStage tracking;
  WindowStage window;
  SyncRunner sync_runner;
  TrackingRunner tracking_runner;
  WindowRunner window_runner;
  JournalRunner journal_runner;
  BackgroundRunner background_runner;
  StageThread sync_thread;
  StageThread tracking_thread;
  StageThread window_thread;
  StageThread journal_thread;
  StageThread background_thread;

  LivenessCheck liveness;
  OverloadLadder ladder;
  std::array<std::uint64_t, 3> signs_seen{};
  HostTime started;
  std::optional<HostTime> first_event;
  std::optional<std::chrono::nanoseconds> first_pose;
};

LivePipeline::LivePipeline(LiveDevices devices, const RigCalibration& calibration,
                           const OdometryConfig& odometry, const SyncConfig& sync,
                           LiveOutputs outputs, const LiveConfig& config)
    : parts_(std::make_unique<Parts>(std::move(devices), calibration, odometry, sync,
                                     std::move(outputs), config)) {}

LivePipeline::~LivePipeline() { stop(); }

// Consumers first: nothing is delivered before somebody takes it.
void LivePipeline::start() {
  Parts& p = *parts_;
  p.started = p.clock.now();
  p.background_thread.start([&p] { p.background_runner.run(p.background_thread); });
  p.journal_thread.start([&p] { p.journal_runner.run(p.journal_thread); });
  p.window_thread.start([&p] { p.window_runner.run(p.window_thread); });
  p.tracking_thread.start([&p] { p.tracking_runner.run(p.tracking_thread); });
  p.sync_thread.start([&p] { p.sync_runner.run(p.sync_thread); });
  p.camera.start();
  p.lidar.start();
  p.trigger.start();
  p.watch();
}

void LivePipeline::Parts::watch() {
  for (const StageThread* thread :
       {&camera.thread(), &lidar.thread(), &trigger.thread(), &std::as_const(sync_thread),
        &std::as_const(tracking_thread), &std::as_const(window_thread),
        &std::as_const(journal_thread), &std::as_const(background_thread)}) {
    liveness.watch(thread->name(), thread->heart());
  }
}

// From the source to the end: each stage finds all that the one before has left it.
void LivePipeline::stop() {
  Parts& p = *parts_;
  p.camera.stop();
  p.lidar.stop();
  p.trigger.stop();
  p.sync_thread.stop();
  p.tracking_thread.stop();
  p.window_thread.stop();
  p.journal_thread.stop();
  p.background_thread.stop();
}

bool LivePipeline::ended() const {
  return parts_->camera.ended() && parts_->lidar.ended() && parts_->trigger.ended();
}

std::vector<std::string> LivePipeline::remarks() { return parts_->remarks.take(); }

std::vector<std::string> LivePipeline::standing_still() {
  return parts_->liveness.standing_still();
}

std::vector<TrajectoryPose> LivePipeline::trajectory() const {
  return parts_->journal_runner.trajectory().poses();
}

std::vector<TrajectoryPose> LivePipeline::trajectory(
    const std::map<std::uint64_t, Eigen::Isometry3d>& T_world_keyframes) const {
  return parts_->journal_runner.trajectory().poses(T_world_keyframes);
}

const CameraIntrinsics& LivePipeline::camera() const { return parts_->window.camera(); }

OverloadSigns LivePipeline::Parts::signs() {
  const LiveShared::Counters& c = shared.counters;
  const std::array<std::uint64_t, 3> now{c.background_behind.load(), c.window_behind.load(),
                                         c.tracking_behind.load()};
  const auto before = std::exchange(signs_seen, now);
  return {.background = now[0] != before[0],
          .window = now[1] != before[1],
          .tracking = now[2] != before[2]};
}

LiveState LivePipeline::Parts::state(const LiveStatus& status) const {
  const HostTime last_ready{std::chrono::nanoseconds(shared.last_ready_ns.load())};
  if (shared.counters.frames_ready == 0) {
    return status.sync.camera.frames == 0 ? LiveState::kWaiting : LiveState::kSynchronizing;
  }
  if (status.at - last_ready > kBlindAfter) return LiveState::kBlind;
  if (shared.counters.frames_tracked == 0) return LiveState::kSynchronizing;
  const LivePose& pose = shared.pose.value();
  if (pose.status == FrameOutcome::Status::kLost) return LiveState::kLost;
  return in_its_place(status.map, pose.submap) ? LiveState::kTracking : LiveState::kRelocalizing;
}

void LivePipeline::Parts::count_work(LiveStatus& status) const {
  const LiveShared::Counters& c = shared.counters;
  status.frames = c.frames_ready;
  status.frames_tracked = c.frames_tracked;
  status.frames_predicted = c.frames_predicted;
  status.frames_lost = c.frames_lost;
  status.frames_dropped = c.frames_dropped;
  status.keyframes = c.keyframes;
  status.deadlines_missed = c.deadlines_missed;
  status.records_dropped = c.records_dropped;
  status.previews_left_out = c.previews_left_out;
  status.searches_left_out = c.searches_left_out;
  status.windows_shortened = c.windows_shortened;
  status.frames_coarse = c.frames_coarse;
  status.pose_searches_cut = c.pose_searches_cut;
  status.phase_locked = shared.phase_locked;
  status.wake_up = shared.wake_up.snapshot();
  status.tracking_time = shared.tracking_time.snapshot();
  status.window_time = shared.window_time.snapshot();
  status.exposure_to_pose = shared.exposure_to_pose.snapshot();
  status.arrival_to_pose = shared.arrival_to_pose.snapshot();
}

LiveStatus LivePipeline::look() {
  Parts& p = *parts_;
  LiveStatus status{.at = p.clock.now()};
  status.running = status.at - p.started;
  status.camera = p.camera.status();
  status.lidar = p.lidar.status();
  status.trigger = p.trigger.status();
  p.sync_runner.state().refresh();
  status.sync = p.sync_runner.state().value();
  p.shared.rung.store(p.ladder.look(status.at, p.signs()), std::memory_order_relaxed);
  status.shed = p.ladder.rung();
  p.count_work(status);
  p.shared.pose.refresh();
  p.shared.map_for_state.refresh();
  status.map = p.shared.map_for_state.value();
  status.state = p.state(status);
  if (status.frames_tracked > 0 && p.shared.pose.value().status != FrameOutcome::Status::kLost) {
    status.pose = p.shared.pose.value();
  }
  if (!p.first_event && status.camera.events > 0) p.first_event = status.at;
  if (!p.first_pose && p.first_event && status.frames_tracked > 0) {
    p.first_pose = status.at - *p.first_event;
  }
  status.first_pose = p.first_pose;
  return status;
}

}  // namespace sparsight
