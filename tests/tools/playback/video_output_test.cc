#include "tools/playback/video_output.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <deque>
#include <map>
#include <vector>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// A driver that takes frames into two buffers and keeps them until it is told to let them go.
class FakeOutput final : public SystemCalls {
 public:
  std::uint32_t abilities = V4L2_CAP_VIDEO_OUTPUT | V4L2_CAP_STREAMING;
  std::uint32_t stride = 8;
  std::uint32_t width_instead = 0;
  std::uint32_t reader_buffers = 2;
  std::vector<v4l2_buffer> queued;
  std::deque<std::uint32_t> done;
  std::map<std::uint32_t, std::vector<std::uint8_t>> memory;
  bool streaming = false;
  int mapped = 0;

  int open(const std::string&) override { return 5; }
  void close(int) override {}
  void* map(int, std::size_t length, std::uint32_t offset) override {
    ++mapped;
    memory[offset].resize(length);
    return memory[offset].data();
  }
  void unmap(void*, std::size_t) override { --mapped; }
  int poll(int, short, std::chrono::nanoseconds) override { return 0; }
  void sleep(std::chrono::nanoseconds) override {}
  HostTime now() override { return {}; }

  int ioctl(int, unsigned long request, void* argument) override {
    auto* buffer = static_cast<v4l2_buffer*>(argument);
    switch (request) {
      case VIDIOC_QUERYCAP:
        static_cast<v4l2_capability*>(argument)->capabilities = abilities;
        return 0;
      case VIDIOC_S_FMT: {
        auto& pixels = static_cast<v4l2_format*>(argument)->fmt.pix;
        if (width_instead != 0) pixels.width = width_instead;
        pixels.bytesperline = stride;
        pixels.sizeimage = stride * pixels.height;
        return 0;
      }
      case VIDIOC_REQBUFS:
        static_cast<v4l2_requestbuffers*>(argument)->count = 2;
        return 0;
      case VIDIOC_QUERYBUF:
        buffer->length = 2 * stride;
        buffer->m.offset = buffer->index % reader_buffers;
        return 0;
      case VIDIOC_QBUF:
        queued.push_back(*buffer);
        return 0;
      case VIDIOC_DQBUF:
        if (done.empty()) return -EAGAIN;
        buffer->index = done.front();
        done.pop_front();
        return 0;
      case VIDIOC_STREAMON:
        streaming = true;
        return 0;
      case VIDIOC_STREAMOFF:
        streaming = false;
        return 0;
      default:
        return -ENOTTY;
    }
  }
};

CameraFrame small_frame() {
  return {.format = PixelFormat::kGrey8,
          .width = 6,
          .height = 2,
          .stride_bytes = 6,
          .bytes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}};
}

TEST(VideoOutput, WritesRowsWithTheDriversStrideAndTheStampGiven) {
  FakeOutput video;
  auto output = VideoOutput::open("/dev/video10", small_frame(), video);
  ASSERT_TRUE(output) << output.error().message;
  EXPECT_TRUE(video.streaming);
  ASSERT_EQ((*output)->write(small_frame(), HostTime(12s + 345678901ns)), 0);
  ASSERT_EQ(video.queued.size(), 1U);
  EXPECT_EQ(video.queued[0].timestamp.tv_sec, 12);
  EXPECT_EQ(video.queued[0].timestamp.tv_usec, 345678);
  EXPECT_EQ(video.queued[0].bytesused, 16U);
  const std::vector<std::uint8_t> expected{1, 2, 3, 4, 5, 6, 0, 0, 7, 8, 9, 10, 11, 12, 0, 0};
  EXPECT_EQ(video.memory[video.queued[0].index], expected);
  output->reset();
  EXPECT_FALSE(video.streaming);
  EXPECT_EQ(video.mapped, 0);
}

TEST(VideoOutput, UsesBuffersAgainAndSaysWhenThereIsNone) {
  FakeOutput video;
  auto output = VideoOutput::open("/dev/video10", small_frame(), video);
  ASSERT_TRUE(output) << output.error().message;
  EXPECT_EQ((*output)->write(small_frame(), HostTime(1s)), 0);
  EXPECT_EQ((*output)->write(small_frame(), HostTime(2s)), 0);
  EXPECT_EQ((*output)->write(small_frame(), HostTime(3s)), -EAGAIN);
  video.done.push_back(1);
  EXPECT_EQ((*output)->write(small_frame(), HostTime(4s)), 0);
  EXPECT_EQ(video.queued.back().index, 1U);
}

TEST(VideoOutput, WritesWhereTheIndexPointsSinceTheReaderCame) {
  FakeOutput video;
  auto output = VideoOutput::open("/dev/video10", small_frame(), video);
  ASSERT_TRUE(output) << output.error().message;
  video.reader_buffers = 1;
  EXPECT_EQ((*output)->write(small_frame(), HostTime(1s)), 0);
  CameraFrame second = small_frame();
  second.bytes[0] = 77;
  EXPECT_EQ((*output)->write(second, HostTime(2s)), 0);
  EXPECT_EQ(video.queued.back().index, 1U);
  EXPECT_EQ(video.memory[0][0], 77);
}

TEST(VideoOutput, RefusesAFrameUnlikeTheFirst) {
  FakeOutput video;
  auto output = VideoOutput::open("/dev/video10", small_frame(), video);
  ASSERT_TRUE(output) << output.error().message;
  CameraFrame other = small_frame();
  other.width = 4;
  EXPECT_EQ((*output)->write(other, HostTime(1s)), -EINVAL);
}

TEST(VideoOutput, RefusesANodeThatTakesNothingOrAnotherSize) {
  FakeOutput video;
  video.abilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_FALSE(VideoOutput::open("/dev/video10", small_frame(), video));
  video.abilities |= V4L2_CAP_VIDEO_OUTPUT;
  video.width_instead = 640;
  const auto output = VideoOutput::open("/dev/video10", small_frame(), video);
  ASSERT_FALSE(output);
  EXPECT_NE(output.error().message.find("GREY 6x2"), std::string::npos) << output.error().message;
}

}  // namespace
}  // namespace sparsight
