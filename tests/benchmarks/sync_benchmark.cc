#include <benchmark/benchmark.h>

#include <chrono>

#include "realtime/sync/grey_image.h"
#include "realtime/sync/lidar_buffer.h"
#include "realtime/sync/lidar_clock.h"
#include "tests/realtime/sync/made_lidar.h"

namespace sparsight {
namespace {

// A turn of a VLP-16 that sees something everywhere: 29,000 returns.
void sweep_of_a_turn(benchmark::State& state) {
  MadeLidar lidar;
  LidarBuffer buffer;
  for (int i = 0; i < 300; ++i) {
    DecodedPacket packet = lidar.next();
    buffer.add(packet);
  }
  const ClockLine line{.sensor = MadeLidar::kStart, .host = lidar.host_time(MadeLidar::kStart)};
  const HostTime now = lidar.host_time(lidar.now()) + std::chrono::milliseconds(10);
  Sweep sweep;
  for (auto _ : state) {
    sweep = {};  // as of a new frame
    benchmark::DoNotOptimize(buffer.sweep(now, line, now, sweep));
  }
  state.counters["returns"] = static_cast<double>(sweep.returns.size());
}
BENCHMARK(sweep_of_a_turn)->Unit(benchmark::kMicrosecond);

// A packet's part in the clock, once its windows are full: 754 of them come in a second.
void lidar_clock_of_a_packet(benchmark::State& state) {
  MadeLidar lidar({.rays = 0});
  LidarClock clock;
  for (int i = 0; i < 30'000; ++i) clock.add(lidar.next());
  std::vector<DecodedPacket> packets;
  for (int i = 0; i < 30'000; ++i) packets.push_back(lidar.next());
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == packets.size()) {
      state.PauseTiming();
      for (DecodedPacket& packet : packets) packet = lidar.next();
      i = 0;
      state.ResumeTiming();
    }
    clock.add(packets[i++]);
  }
}
BENCHMARK(lidar_clock_of_a_packet)->Unit(benchmark::kNanosecond);

void image_of_a_frame(benchmark::State& state) {
  const auto format = static_cast<PixelFormat>(state.range(0));
  CameraFrame frame;
  frame.format = format;
  frame.width = 800;
  frame.height = 600;
  frame.stride_bytes = format == PixelFormat::kYuyv || format == PixelFormat::kGrey10 ? 1600 : 800;
  frame.bytes.assign(800 * 600 * 2, 100);
  for (auto _ : state) benchmark::DoNotOptimize(convert_image(frame, state.range(1) != 0, {}));
}
BENCHMARK(image_of_a_frame)
    ->Unit(benchmark::kMicrosecond)
    ->ArgNames({"format", "color"})
    ->Args({static_cast<int>(PixelFormat::kGrey8), 0})
    ->Args({static_cast<int>(PixelFormat::kGrey10), 0})
    ->Args({static_cast<int>(PixelFormat::kBayerRggb8), 0})
    ->Args({static_cast<int>(PixelFormat::kBayerRggb8), 1})
    ->Args({static_cast<int>(PixelFormat::kYuyv), 0})
    ->Args({static_cast<int>(PixelFormat::kYuyv), 1})
    ->Args({static_cast<int>(PixelFormat::kNv12), 1});

}  // namespace
}  // namespace sparsight
