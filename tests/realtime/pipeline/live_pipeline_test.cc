#include "realtime/pipeline/live_pipeline.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "realtime/pipeline/deterministic_replay.h"
#include "realtime/sync/rig_frame_source.h"
#include "tests/realtime/pipeline/made_walk.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// On a busy machine the first keyframe takes some frames to be made.
constexpr std::uint64_t kMostUntracked = 10;

// Runs a walk through the threads; what comes out is kept as it came.
struct LiveWalk {
  explicit LiveWalk(int frames) : walk(frames) {
    config.realtime = false;
    odometry.keyframes.max_age_s = 0.2;
  }

  void run() {
    walk.begin_at(HostClock::now() + 50ms);
    LivePipeline pipeline(played_devices(walk), walk.calibration(), odometry, {}, outputs(),
                          config);
    pipeline.start();
    while (!pipeline.ended()) {
      status = pipeline.look();
      highest = std::max(highest, status.shed);
      if (status.state == LiveState::kTracking) seen_tracking = true;
      std::this_thread::sleep_for(10ms);
    }
    pipeline.stop();
    status = pipeline.look();
    trajectory = pipeline.trajectory();
    remarks = pipeline.remarks();
  }

  LiveOutputs outputs() {
    LiveOutputs outputs;
    outputs.on_event = [this](RigEvent&& event) { ++recorded[event.index()]; };
    outputs.on_frame = [this](FrameRecord&& record) { frames.push_back(std::move(record)); };
    outputs.on_preview = [this](const LivePreview&) { ++previews; };
    outputs.on_keyframe = [this](RetiredKeyframe&& keyframe, const KeyframeEffort&) {
      keyframes.push_back(std::move(keyframe));
      return MapPlace{};
    };
    return outputs;
  }

  std::uint64_t raw_events() const {
    return walk.frames().size() + walk.edges().size() + walk.packets().size();
  }
  std::uint64_t raw_recorded() const {
    std::uint64_t sum = 0;
    for (const auto& [index, count] : recorded) sum += index < 4 ? count : 0;
    return sum;
  }

  MadeWalk walk;
  OdometryConfig odometry = room_config();
  LiveConfig config;
  LiveStatus status;
  Shed highest = Shed::kNothing;
  bool seen_tracking = false;
  std::map<std::size_t, std::uint64_t> recorded;  // by kind
  std::vector<FrameRecord> frames;
  std::vector<RetiredKeyframe> keyframes;
  std::vector<TrajectoryPose> trajectory;
  std::vector<std::string> remarks;
  int previews = 0;
};

TEST(LivePipeline, TracksWhatItsDevicesDeliverAsTheReplayWould) {
  LiveWalk live(36);
  live.config.frames_in_flight = 64;  // none is dropped, however slow the machine
  live.run();
  EXPECT_TRUE(live.seen_tracking);
  EXPECT_GE(live.status.frames, 26U) << "all but those before the edges are trusted";
  EXPECT_EQ(live.status.frames_dropped, 0U);
  const std::size_t untracked = live.status.frames_predicted;
  EXPECT_LE(untracked, kMostUntracked);
  ASSERT_EQ(live.frames.size(), live.status.frames);
  for (std::size_t i = 0; i < live.frames.size(); ++i) EXPECT_EQ(live.frames[i].sequence, i);
  EXPECT_EQ(live.raw_recorded(), live.raw_events());
  EXPECT_EQ(live.keyframes.size(), live.status.keyframes) << "the window is emptied at the end";
  EXPECT_GE(live.keyframes.size(), 3U);
  EXPECT_TRUE(live.remarks.empty());

  RigFrameSource source(std::make_unique<MadeEventSource>(live.walk.events()), live.walk.decoder(),
                        live.walk.calibration(), {});
  Odometry odometry(live.walk.calibration(), live.odometry);
  const auto replayed = replay_deterministic(source, odometry, std::nullopt, {}).odometry;
  ASSERT_EQ(live.trajectory.size(), replayed.size());
  for (std::size_t i = 1 + untracked; i < replayed.size(); ++i) {
    // Of an edge that comes later than its frame it is known where it must be, to nanoseconds.
    EXPECT_LT(std::chrono::abs(live.trajectory[i].exposure - replayed[i].exposure), 1us);
    EXPECT_LT(shift_between(live.trajectory[i].T_world_camera, replayed[i].T_world_camera), 0.01);
  }
}

// How far each stage climbs is exact in overload_test.cc; here other programs may slow the rest.
TEST(LivePipeline, LeavesOutIterationsWhenTheWindowIsBehindAndNeverRawData) {
  LiveWalk live(45);
  live.odometry.keyframes.max_age_s = 0.05;
  live.config.probe = [](LiveStage stage) {
    if (stage == LiveStage::kWindow) std::this_thread::sleep_for(250ms);
  };
  live.run();
  EXPECT_GE(live.highest, Shed::kWindowIterations);
  EXPECT_GE(live.status.windows_shortened, 1U);
  EXPECT_LE(live.status.frames_predicted, kMostUntracked) << "tracking waits for nobody";
  EXPECT_EQ(live.raw_recorded(), live.raw_events());
}

TEST(LivePipeline, LeavesOutLevelsWhenTrackingItselfIsBehind) {
  LiveWalk live(45);
  live.config.probe = [](LiveStage stage) {
    if (stage == LiveStage::kTracking) std::this_thread::sleep_for(45ms);
  };
  live.run();
  EXPECT_EQ(live.highest, Shed::kTrackingLevels);
  EXPECT_GE(live.status.deadlines_missed, 5U);
  EXPECT_GE(live.status.frames_coarse, 5U);
  EXPECT_GE(live.status.previews_left_out, 5U);
  EXPECT_EQ(live.raw_recorded(), live.raw_events());
}

TEST(LivePipeline, LeavesOutLoopSearchesWhenTheBackgroundIsBehind) {
  LiveWalk live(45);
  live.odometry.keyframes.max_age_s = 0.05;
  live.odometry.window.size = 2;
  live.config.probe = [](LiveStage stage) {
    if (stage == LiveStage::kBackground) std::this_thread::sleep_for(400ms);
  };
  live.run();
  EXPECT_GE(live.highest, Shed::kLoopSearch);
  EXPECT_GE(live.status.searches_left_out, 1U);
  EXPECT_EQ(live.keyframes.size(), live.status.keyframes) << "no keyframe is lost";
}

TEST(LivePipeline, GoesOnWithoutASensorThatDoesNotStart) {
  class NoLidar final : public Lidar {
   public:
    Result<void> start() override { return fail(ErrorCode::kNotFound, "no network"); }
    std::optional<LidarMessage> read(std::chrono::nanoseconds) override { return std::nullopt; }
    void stop() override {}
    DeviceState state() const override { return DeviceState::kStopped; }
    LidarCounters counters() const override { return {}; }
  };
  LiveWalk live(12);
  live.walk.begin_at(HostClock::now() + 50ms);
  LiveDevices devices = played_devices(live.walk);
  devices.lidar = std::make_shared<NoLidar>();
  LivePipeline pipeline(std::move(devices), live.walk.calibration(), live.odometry, {},
                        live.outputs(), live.config);
  pipeline.start();
  std::this_thread::sleep_for(650ms);
  live.status = pipeline.look();
  pipeline.stop();
  EXPECT_EQ(live.status.lidar.state, DeviceState::kGone);
  EXPECT_EQ(live.status.lidar.message, "no network");
  EXPECT_EQ(live.recorded[0], live.walk.frames().size()) << "what comes is recorded";
  EXPECT_EQ(live.status.state, LiveState::kSynchronizing) << "and without depth nothing is tracked";
}

// A process that is called as the kernel calls the thread of an interrupt.
class StandInInterrupt {
 public:
  explicit StandInInterrupt(int number) : name_("irq/" + std::to_string(number) + "-made") {
    std::array<int, 2> named{};
    if (pipe(named.data()) != 0) return;
    pid_ = fork();
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      prctl(PR_SET_NAME, name_.c_str());
      close(named[0]);
      close(named[1]);
      for (;;) pause();
    }
    close(named[1]);
    char nothing = 0;
    while (read(named[0], &nothing, 1) > 0) continue;  // until the child has closed its end
    close(named[0]);
  }
  ~StandInInterrupt() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  StandInInterrupt(const StandInInterrupt&) = delete;
  StandInInterrupt& operator=(const StandInInterrupt&) = delete;

  int priority() const {
    sched_param parameters{};
    const bool fifo = sched_getscheduler(pid_) == SCHED_FIFO;
    return fifo && sched_getparam(pid_, &parameters) == 0 ? parameters.sched_priority : 0;
  }

 private:
  std::string name_;
  pid_t pid_ = -1;
};

// A device that hangs on a controller of that interrupt, as /sys has it.
template <typename Played>
struct OnController final : Played {
  OnController(std::vector<RigEvent> events, int number)
      : Played(std::move(events)),
        folder(std::filesystem::path(::testing::TempDir()) / ("made_" + std::to_string(number))) {
    std::filesystem::create_directories(folder / "made");
    std::ofstream(folder / "irq") << number << "\n";
  }
  std::filesystem::path system_folder() const override { return folder / "made"; }

  std::filesystem::path folder;
};

TEST(LivePipeline, RaisesTheInterruptsThatItsDevicesComeBy) {
  const StandInInterrupt of_camera(4194301);
  const StandInInterrupt of_lidar(4194302);
  const StandInInterrupt of_another(4194303);
  LiveWalk live(12);
  live.config.realtime = true;
  live.walk.begin_at(HostClock::now() + 50ms);
  LiveDevices devices = played_devices(live.walk);
  devices.camera = std::make_shared<OnController<PlayedCamera>>(live.walk.frames(), 4194301);
  devices.lidar = std::make_shared<OnController<PlayedLidar>>(live.walk.packets(), 4194302);
  LivePipeline pipeline(std::move(devices), live.walk.calibration(), live.odometry, {},
                        live.outputs(), live.config);
  pipeline.start();
  std::this_thread::sleep_for(200ms);
  pipeline.stop();
  if (!pipeline.remarks().empty()) GTEST_SKIP() << "real-time scheduling is not for us";
  EXPECT_GT(of_camera.priority(), 65) << "above the thread that takes its frames";
  EXPECT_GT(of_lidar.priority(), 70);
  EXPECT_EQ(of_another.priority(), 0);
}

}  // namespace
}  // namespace sparsight
