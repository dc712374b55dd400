#include "realtime/pipeline/stage_thread.h"

#include <algorithm>
#include <exception>

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
    try {
      run();
    } catch (const std::exception& error) {
      // The other stages go on, the recording among them; the watchdog sees that this one does not.
      remarks_.add("the thread " + settings_.name + " broke off: " + error.what());
    }
    running_ = false;
  });
}

void StageThread::stop() {
  stopping_.store(true, std::memory_order_release);
  if (thread_.joinable()) thread_.join();
}

}  // namespace sparsight
