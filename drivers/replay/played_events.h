#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "hal/rig_event.h"

namespace sparsight {

// The same event, `by` later; a frame's as of so many restarts of the camera more.
RigEvent moved(const RigEvent& event, std::chrono::nanoseconds by, std::uint32_t restarts = 0);

// Events of another day as if they happened from now on: all times are moved, and a thread reads
// ahead, so that whoever plays them in real time never waits for the disk. Thread-bound.
class PlayedEvents final : public RigEventSource {
 public:
  // `ahead` events wait at most: 2000 are two seconds of a rig, 70 frames among them.
  PlayedEvents(std::unique_ptr<RigEventSource> events, std::chrono::nanoseconds by,
               std::size_t ahead = 2000);
  ~PlayedEvents() override;
  PlayedEvents(const PlayedEvents&) = delete;
  PlayedEvents& operator=(const PlayedEvents&) = delete;

  std::optional<RigEvent> next() override;

 private:
  void run();

  const std::unique_ptr<RigEventSource> events_;  // the reading thread's
  const std::chrono::nanoseconds by_;
  const std::size_t ahead_;
  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::deque<RigEvent> waiting_;
  bool ended_ = false;
  bool stopping_ = false;
  std::thread thread_;  // last, so that it finds the rest constructed
};

}  // namespace sparsight
