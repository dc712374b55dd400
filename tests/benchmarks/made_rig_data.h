#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>

#include "hal/camera.h"
#include "hal/image.h"
#include "hal/lidar.h"

namespace sparsight {

// The hall as a camera sees it: with the noise of its sensor, which decides how well it packs.
inline std::shared_ptr<CameraFrame> noisy_frame(const GreyImage& image, std::mt19937& random) {
  auto frame = std::make_shared<CameraFrame>();
  frame->width = image.width;
  frame->height = image.height;
  frame->stride_bytes = image.width;
  frame->bytes = image.pixels;
  std::normal_distribution<float> noise(0.0F, 2.0F);
  for (std::uint8_t& byte : frame->bytes) {
    byte = static_cast<std::uint8_t>(std::clamp(std::lround(byte + noise(random)), 0L, 255L));
  }
  return frame;
}

// Ranges that change slowly along each laser's ring, with noise of a centimetre and reflectivities.
inline LidarPacket made_packet(HostTime arrival, std::mt19937& random) {
  LidarPacket packet{arrival};
  for (std::size_t i = 0; i < 12; ++i) {
    std::uint8_t* block = packet.payload.data() + 100 * i;
    block[0] = 0xff;
    block[1] = 0xee;
    for (std::size_t laser = 0; laser < 32; ++laser) {
      const std::size_t range = 1000 + 40 * (laser % 16) + random() % 8;
      block[4 + 3 * laser] = static_cast<std::uint8_t>(range);
      block[5 + 3 * laser] = static_cast<std::uint8_t>(range >> 8);
      block[6 + 3 * laser] = static_cast<std::uint8_t>(random() % 60);
    }
  }
  return packet;
}

inline double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace sparsight
