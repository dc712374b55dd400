#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "realtime/executor/heartbeat.h"
#include "realtime/executor/thread_setup.h"

namespace sparsight {

// What the system refused to the threads, each kind once. Thread-safe.
class SetupRemarks {
 public:
  void add(const std::string& remark);
  std::vector<std::string> take();

 private:
  std::mutex mutex_;
  std::vector<std::string> all_;
  std::vector<std::string> untold_;
};

// A thread of the pipeline: set up as asked, told to end by a flag that it looks at, with a
// heartbeat that it beats once a round. Thread-bound but for what the thread itself calls.
class StageThread {
 public:
  StageThread(ThreadSettings settings, SetupRemarks& remarks)
      : settings_(std::move(settings)), remarks_(remarks) {}
  ~StageThread() { stop(); }
  StageThread(const StageThread&) = delete;
  StageThread& operator=(const StageThread&) = delete;

  void start(std::function<void()> run);
  // Asks it to end, and waits until it has.
  void stop();

  // For the thread itself.
  void beat() noexcept { heart_.beat(); }
  bool stopping() const noexcept { return stopping_.load(std::memory_order_acquire); }

  const Heartbeat& heart() const { return heart_; }
  bool running() const noexcept { return running_.load(std::memory_order_acquire); }
  const std::string& name() const { return settings_.name; }

 private:
  ThreadSettings settings_;
  SetupRemarks& remarks_;
  Heartbeat heart_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> running_{false};
  std::thread thread_;
};

}  // namespace sparsight
