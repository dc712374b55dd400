#include "realtime/pipeline/stage_thread.h"

#include <algorithm>

namespace sparsight {

void SetupRemarks::add(const std::string& remark) {
  const std::lock_guard lock(mutex_);
  if (std::find(all_.begin(), all_.end(), remark) != all_.end()) return;
  all_.push_back(remark);
  untold_.push_back(remark);
}

std::vector<std::string> SetupRemarks::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(untold_, {});
}

void StageThread::start(std::function<void()> run) {
  running_ = true;
  thread_ = std::thread([this, run = std::move(run)] {
    if (const auto remark = set_up_thread(settings_)) remarks_.add(*remark);
    run();
    running_ = false;
  });
}

void StageThread::stop() {
  stopping_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
}

}  // namespace sparsight
