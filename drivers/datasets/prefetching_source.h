#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hal/frame_source.h"

namespace sparsight {

// Reads a source ahead on a thread of its own, so that decoding and tracking overlap. The frames
// and their order are the source's own.
class PrefetchingSource : public FrameSource {
 public:
  // At most `ahead` frames are held ready.
  PrefetchingSource(std::unique_ptr<FrameSource> source, std::size_t ahead);
  ~PrefetchingSource() override;
  PrefetchingSource(const PrefetchingSource&) = delete;
  PrefetchingSource& operator=(const PrefetchingSource&) = delete;

  const RigCalibration& calibration() const override { return calibration_; }
  std::optional<std::size_t> frame_count() const override { return frame_count_; }
  std::optional<SynchronizedFrame> next() override;

 private:
  void load();

  const std::unique_ptr<FrameSource> source_;  // the loader's alone once it runs
  const RigCalibration calibration_;
  const std::optional<std::size_t> frame_count_;
  const std::size_t ahead_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<SynchronizedFrame> ready_;
  bool exhausted_ = false;  // the source has no more
  bool stopping_ = false;   // nobody wants more

  std::thread loader_;  // last, so that it finds the rest constructed
};

}  // namespace sparsight
