#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/vlp16/made_capture.h"
#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight::testing {

// The second, since 1970, at which made captures begin: 800 s after a full hour.
inline constexpr std::int64_t kCaptureSecond = 1'700'000'000;
inline constexpr std::int64_t kPastHour = kCaptureSecond % 3600;

inline void write_capture(const fs::path& file, const MadeCapture& capture) {
  write_file(file, {capture.bytes().begin(), capture.bytes().end()});
}

// A capture of half a second and ten images of 40 x 16 pixels within it, to be damaged by tests.
struct MadeCaptureFolder {
  TemporaryFolder temporary;
  const fs::path& folder = temporary.path();

  MadeCaptureFolder() {
    MadeCapture capture;
    for (std::uint32_t i = 0; i < 377; ++i) add_packet(capture, i, 0);
    write_capture(folder / "lidar.pcap", capture);
    for (int i = 0; i < 10; ++i) write_image(image(i), small_image(CV_8UC1, i, 40, 16));
    write_times(0.05);
    write_file(folder / "rig.toml",
               "[camera]\nwidth = 40\nheight = 16\n"
               "[calibration.camera]\nwidth = 40\nheight = 16\n"
               "fx = 30.0\nfy = 30.0\ncx = 19.5\ncy = 7.5\n"
               "[calibration.T_camera_lidar]\n"
               "translation_m = [0.0, -0.12, -0.05]\nquaternion_wxyz = [0.5, 0.5, -0.5, 0.5]\n");
  }

  fs::path image(int i) const { return folder / "images" / fmt::format("frame_{}.png", i + 1); }
  // Ten times 40 ms apart.
  void write_times(double first_s, const std::string& above = "", std::int64_t base = 0) const {
    std::string text = above;
    for (int i = 0; i < 10; ++i) {
      text += fmt::format(
          "{:.6f}\n", static_cast<double>(base != 0 ? base : kCaptureSecond) + first_s + 0.04 * i);
    }
    write_file(folder / "times.txt", text);
  }

  // Packet i of the sensor, captured `late_us` after it could have been.
  static void add_packet(MadeCapture& capture, std::uint32_t i, std::uint32_t late_us,
                         std::uint32_t sensor_ahead_us = 0) {
    const auto began = static_cast<std::uint32_t>(i * 1327.104);
    const MadePacket made{
        .first_azimuth_centideg = static_cast<int>(i * 478 % 36000),
        .microseconds_past_hour =
            static_cast<std::uint32_t>(kPastHour * 1'000'000) + began + sensor_ahead_us};
    const DataPayload payload = payload_of(made);
    // 1306.4 us until its last firing, 99.8 us on the wire.
    const std::uint32_t captured = began + 1406 + late_us;
    capture.add(static_cast<std::uint32_t>(kCaptureSecond) + captured / 1'000'000,
                captured % 1'000'000, frame_of({.payload = {payload.begin(), payload.end()}}));
  }
};

}  // namespace sparsight::testing
