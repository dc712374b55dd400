#include "drivers/datasets/prefetching_source.h"

#include <algorithm>
#include <utility>

namespace sparsight {

PrefetchingSource::PrefetchingSource(std::unique_ptr<FrameSource> source, std::size_t ahead)
    : source_(std::move(source)),
      calibration_(source_->calibration()),
      frame_count_(source_->frame_count()),
      ahead_(std::max<std::size_t>(ahead, 1)),
      loader_([this] { load(); }) {}

PrefetchingSource::~PrefetchingSource() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  loader_.join();
}

std::optional<SynchronizedFrame> PrefetchingSource::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty() || exhausted_; });
  if (ready_.empty()) return std::nullopt;
  SynchronizedFrame frame = std::move(ready_.front());
  ready_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return frame;
}

void PrefetchingSource::load() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ready_.size() < ahead_ || stopping_; });
      if (stopping_) return;
    }
    std::optional<SynchronizedFrame> frame = source_->next();  // the slow part, unlocked
    {
      const std::lock_guard lock(mutex_);
      exhausted_ = !frame;
      if (frame) ready_.push_back(std::move(*frame));
    }
    changed_.notify_all();
    if (!frame) return;
  }
}

}  // namespace sparsight
