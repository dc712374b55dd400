#include "hal/camera.h"

#include <algorithm>

#include "drivers/v4l2/pixel_format_code.h"
#include "tests/contract/device_contract.h"

namespace sparsight::contract {
namespace {

class CameraContract : public DeviceContract<Camera> {};
SPARSIGHT_DEVICE_CONTRACT(CameraContract)

TEST_P(CameraContract, FramesComeInTheirOrder) {
  start();
  const auto frames = read_all(device());
  ASSERT_GE(frames.size(), 10U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_LE(frames[i].driver_time, frames[i].arrival) << "nothing arrives before it happens";
    if (i == 0) continue;
    EXPECT_GE(frames[i].arrival, frames[i - 1].arrival);
    EXPECT_GE(frames[i].epoch, frames[i - 1].epoch);
    if (frames[i].epoch == frames[i - 1].epoch) {
      EXPECT_GT(frames[i].sequence, frames[i - 1].sequence);
    }
  }
}

TEST_P(CameraContract, FramesHaveTheBytesOfTheirFormat) {
  start();
  for (const CameraFrame& frame : read_all(device())) {
    EXPECT_GT(frame.width, 0);
    EXPECT_GT(frame.height, 0);
    EXPECT_GE(frame.stride_bytes, row_bytes(frame.format, frame.width));
    EXPECT_GE(frame.exposure.count(), 0);
    if (frame.format != PixelFormat::kMjpeg) {
      EXPECT_EQ(frame.bytes.size(), frame_bytes(frame.format, frame.stride_bytes, frame.height));
    }
  }
}

TEST_P(CameraContract, CountersAgreeWithWhatWasRead) {
  start();
  const auto frames = read_all(device());
  std::uint64_t gaps = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].epoch != frames[i - 1].epoch) continue;
    gaps += frames[i].sequence - frames[i - 1].sequence - 1;
  }
  const CameraCounters counters = device().counters();
  EXPECT_EQ(counters.frames, frames.size());
  EXPECT_EQ(counters.lost, gaps);
  EXPECT_EQ(counters.damaged, static_cast<std::uint64_t>(std::count_if(
                                  frames.begin(), frames.end(),
                                  [](const CameraFrame& frame) { return frame.damaged; })));
  EXPECT_EQ(counters.restarts, frames.back().epoch - frames.front().epoch);
}

INSTANTIATE_TEST_SUITE_P(Cameras, CameraContract,
                         ::testing::ValuesIn(registered<Implementation<Camera>>()),
                         NameOfImplementation());

}  // namespace
}  // namespace sparsight::contract
