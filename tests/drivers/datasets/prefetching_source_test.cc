#include "drivers/datasets/prefetching_source.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace sparsight {
namespace {

// Yields numbered frames and counts how many were asked of it.
class CountingSource : public FrameSource {
 public:
  CountingSource(std::uint64_t frames, std::shared_ptr<std::atomic<std::uint64_t>> read)
      : frames_(frames), read_(std::move(read)) {
    calibration_.camera.width = 7;
  }
  const RigCalibration& calibration() const override { return calibration_; }
  std::optional<std::size_t> frame_count() const override { return frames_; }
  std::optional<SynchronizedFrame> next() override {
    if (*read_ == frames_) return std::nullopt;
    SynchronizedFrame frame;
    frame.sequence = (*read_)++;
    frame.grey.pixels.assign(100, static_cast<std::uint8_t>(frame.sequence));
    return frame;
  }

 private:
  RigCalibration calibration_;
  std::uint64_t frames_;
  std::shared_ptr<std::atomic<std::uint64_t>> read_;
};

struct Prefetched {
  std::shared_ptr<std::atomic<std::uint64_t>> read =
      std::make_shared<std::atomic<std::uint64_t>>(0);
  std::unique_ptr<PrefetchingSource> source;
  Prefetched(std::uint64_t frames, std::size_t ahead)
      : source(std::make_unique<PrefetchingSource>(std::make_unique<CountingSource>(frames, read),
                                                   ahead)) {}
};

TEST(PrefetchingSource, YieldsEveryFrameOnceAndInOrder) {
  Prefetched prefetched(1000, 4);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const auto frame = prefetched.source->next();
    ASSERT_TRUE(frame);
    ASSERT_EQ(frame->sequence, i);
    ASSERT_EQ(frame->grey.pixels.at(99), static_cast<std::uint8_t>(i));
  }
  EXPECT_FALSE(prefetched.source->next());
  EXPECT_FALSE(prefetched.source->next()) << "nothing follows the end";
}

TEST(PrefetchingSource, ReadsAheadButNotWithoutBound) {
  Prefetched prefetched(1000, 4);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (*prefetched.read < 4 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(*prefetched.read, 4U) << "nobody has asked yet";
  prefetched.source->next();
  while (*prefetched.read < 5 && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::yield();
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(*prefetched.read, 5U);
}

TEST(PrefetchingSource, CanBeLeftAtAnyMoment) {
  for (int taken = 0; taken < 20; ++taken) {
    Prefetched prefetched(10, 3);
    for (int i = 0; i < taken; ++i) prefetched.source->next();
  }
}

TEST(PrefetchingSource, OfNothingEndsAtOnce) {
  Prefetched prefetched(0, 4);
  EXPECT_FALSE(prefetched.source->next());
}

TEST(PrefetchingSource, PassesCalibrationAndCountOn) {
  Prefetched prefetched(3, 4);
  EXPECT_EQ(prefetched.source->calibration().camera.width, 7);
  EXPECT_EQ(prefetched.source->frame_count(), 3U);
}

}  // namespace
}  // namespace sparsight
