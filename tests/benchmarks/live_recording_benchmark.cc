#include <benchmark/benchmark.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/recording/recorder.h"
#include "drivers/recording/recording_source.h"
#include "realtime/pipeline/deterministic_replay.h"
#include "tests/benchmarks/made_drive.h"
#include "tests/benchmarks/made_rig_data.h"

// A rig recorded in real time while odometry runs beside it: 800 x 600 at 30 Hz with both edges of
// every exposure, a VLP-16, and the hall walked to and fro. What comes out is compared with what
// went in, message by message.
namespace sparsight {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kDuration{10};
constexpr std::chrono::nanoseconds kFramePeriod{33'333'333};
constexpr std::chrono::nanoseconds kPacketPeriod{1'327'104};
constexpr std::int64_t kShots = kDuration / kFramePeriod;
constexpr std::int64_t kPackets = kDuration / kPacketPeriod;
constexpr std::size_t kPictures = 8;

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

const std::vector<std::vector<std::uint8_t>>& pictures() {
  static const auto kAll = [] {
    std::mt19937 random(1);
    std::vector<std::vector<std::uint8_t>> all;
    for (std::size_t i = 0; i < kPictures; ++i) {
      const auto& frames = made_drive(kHall).frames;
      all.push_back(noisy_frame(frames[i % frames.size()].grey, random)->bytes);
    }
    return all;
  }();
  return kAll;
}

HostTime exposed(std::int64_t frame) { return HostTime(1s + frame * kFramePeriod); }
Edge edge_of(std::int64_t frame, bool rising) {
  return {EdgeLine::kExposure, rising, exposed(frame) + (rising ? 0ms : 4ms)};
}
LidarPacket packet_of(std::int64_t number) {
  LidarPacket packet{HostTime(1s + number * kPacketPeriod)};
  std::memcpy(packet.payload.data(), &number, sizeof number);
  return packet;
}
std::shared_ptr<const CameraFrame> frame_of(std::int64_t number) {
  auto frame = std::make_shared<CameraFrame>();
  frame->sequence = static_cast<std::uint32_t>(number);
  frame->driver_time = frame->arrival = exposed(number) + 12ms;
  frame->width = frame->stride_bytes = 800;
  frame->height = 600;
  frame->bytes = pictures()[static_cast<std::size_t>(number) % kPictures];
  return frame;
}

// The frames of the hall to and fro until the recording ends: each not before its time, or flat
// out, which takes a core for itself.
class PacedFrames final : public FrameSource {
 public:
  PacedFrames(Clock::time_point begin, bool flat_out, const std::atomic<bool>& ended)
      : begin_(begin),
        flat_out_(flat_out),
        ended_(ended),
        calibration_(made_drive(kHall).scene.rig) {}
  const RigCalibration& calibration() const override { return calibration_; }
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }
  std::optional<SynchronizedFrame> next() override {
    if (ended_) return std::nullopt;
    if (!flat_out_) std::this_thread::sleep_until(begin_ + (count_ + 1) * kFramePeriod);
    const auto& frames = made_drive(kHall).frames;
    const std::size_t round = 2 * (frames.size() - 1);
    const std::size_t place = static_cast<std::size_t>(count_) % round;
    SynchronizedFrame frame = frames[std::min(place, round - place)];
    frame.sequence = static_cast<std::uint64_t>(count_);
    frame.exposure = exposed(count_++);
    return frame;
  }

 private:
  const Clock::time_point begin_;
  const bool flat_out_;
  const std::atomic<bool>& ended_;
  RigCalibration calibration_;
  std::int64_t count_ = 0;
};

struct LiveShares {
  double cameras = 0.0;  // processor seconds of the threads that hand over
  double lidar = 0.0;
  double odometry = 0.0;
  double process = 0.0;
  double recorder() const { return process - cameras - lidar - odometry; }
  std::size_t tracked = 0;
};

void feed_camera(Recorder& recorder, Clock::time_point begin) {
  for (std::int64_t i = 0; i < kShots; ++i) {
    std::this_thread::sleep_until(begin + i * kFramePeriod);
    recorder.record(edge_of(i, true));
    recorder.record(edge_of(i, false));
    recorder.record(frame_of(i));
  }
}

void feed_lidar(Recorder& recorder, Clock::time_point begin) {
  for (std::int64_t i = 0; i < kPackets; ++i) {
    std::this_thread::sleep_until(begin + i * kPacketPeriod);
    recorder.record(packet_of(i));
  }
}

LiveShares record_while_tracking(Recorder& recorder, bool flat_out) {
  LiveShares shares;
  std::atomic<bool> ended = false;
  const double before = processor_seconds();
  const auto begin = Clock::now() + 50ms;
  std::thread odometry([&] {
    PacedFrames frames(begin, flat_out, ended);
    Odometry estimator(frames.calibration(), {});
    const auto count = [&](const FrameRecord& record) {
      shares.tracked += record.outcome.status == FrameOutcome::Status::kTracked ? 1 : 0;
    };
    replay_deterministic(frames, estimator, std::nullopt, {.on_frame = count});
    shares.odometry = thread_seconds();
  });
  std::thread lidar([&] {
    feed_lidar(recorder, begin);
    shares.lidar = thread_seconds();
  });
  std::thread camera([&] {
    feed_camera(recorder, begin);
    shares.cameras = thread_seconds();
  });
  camera.join();
  lidar.join();
  ended = true;
  odometry.join();
  recorder.finish();
  shares.process = processor_seconds() - before;
  return shares;
}

// Messages that are not there, or not as they were handed over.
std::size_t missing_from(const fs::path& file) {
  auto source = RecordingSource::open(file);
  if (!source) return 1;
  std::int64_t frames = 0;
  std::int64_t packets = 0;
  std::int64_t edges = 0;
  std::size_t wrong = 0;
  while (const auto event = (*source)->next()) {
    bool same = false;
    if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&*event)) {
      const auto expected = frame_of(frames++);
      same = (*frame)->sequence == expected->sequence && (*frame)->bytes == expected->bytes;
    } else if (const auto* packet = std::get_if<LidarPacket>(&*event)) {
      const LidarPacket expected = packet_of(packets++);
      same = packet->arrival == expected.arrival && packet->payload == expected.payload;
    } else if (const auto* edge = std::get_if<Edge>(&*event)) {
      const Edge expected = edge_of(edges / 2, edges % 2 == 0);
      ++edges;
      same = edge->time == expected.time && edge->rising == expected.rising;
    }
    wrong += same ? 0 : 1;
  }
  return wrong + static_cast<std::size_t>(std::abs(kShots - frames) + std::abs(kPackets - packets) +
                                          std::abs(2 * kShots - edges));
}

void record_while_odometry_runs(benchmark::State& state) {
  RecorderConfig config;
  config.file.compression = static_cast<Compression>(state.range(0));
  config.free_space_floor_bytes = 0;
  pictures();
  const fs::path file =
      fs::temp_directory_path() / ("sparsight_live_" + std::to_string(getpid()) + ".mcap");
  for (auto _ : state) {
    fs::remove(file);
    auto recorder = Recorder::create(file, {}, config).value();
    const LiveShares shares = record_while_tracking(*recorder, state.range(1) != 0);
    const RecorderReport report = recorder->finish();
    const double percent = 100.0 / to_seconds(kDuration);
    state.counters["recorder_percent"] = percent * shares.recorder();
    state.counters["handing_over_percent"] = percent * (shares.cameras + shares.lidar);
    state.counters["odometry_percent"] = percent * shares.odometry;
    state.counters["frames_tracked"] = static_cast<double>(shares.tracked);
    state.counters["messages"] = static_cast<double>(3 * kShots + kPackets);
    state.counters["missing"] = static_cast<double>(missing_from(file));
    state.counters["most_queued_MB"] = 1e-6 * static_cast<double>(report.most_queued_bytes);
    state.counters["slowest_write_ms"] = 1e3 * to_seconds(report.slowest_write);
    if (report.lost_anything_raw() || state.counters["missing"] > 0) {
      state.SkipWithError("the recording is not what was handed over");
    }
  }
  fs::remove(file);
}

BENCHMARK(record_while_odometry_runs)
    ->ArgNames({"compression", "flat_out"})
    ->ArgsProduct({{static_cast<int>(Compression::kNone), static_cast<int>(Compression::kLz4),
                    static_cast<int>(Compression::kZstd)},
                   {0, 1}})
    ->Iterations(1)
    ->Unit(benchmark::kSecond)
    ->UseRealTime();

}  // namespace
}  // namespace sparsight
