#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "hal/rig_event.h"
#include "realtime/executor/latency_histogram.h"
#include "realtime/executor/spsc_queue.h"

namespace sparsight {

// Where the events of one device are written to.
struct PlayedDevice {
  // Writes the event into the device, as of `due`. 0, or a negative errno.
  std::function<int(const RigEvent& event, HostTime due)> write;
  std::string name;
  int fifo_priority = 0;  // 0: none
  std::size_t events_ahead = 0;
};

struct PlayedCounts {
  std::uint64_t played = 0;
  std::uint64_t withheld = 0;  // on purpose
  std::uint64_t refused = 0;   // by the device
  int last_errno = 0;          // why, of the last one
  LatencySnapshot late;        // from when an event was due until it began to be written
};

// Plays a rig's events into devices, each when it arrived in its recording, moved by one constant.
// Each device has a thread; the calling one reads ahead of them. Thread-bound.
class DevicePlayer {
 public:
  using Devices = std::array<PlayedDevice, 3>;  // by DeviceKind

  explicit DevicePlayer(Devices devices);

  struct Plan {
    std::function<bool(const RigEvent&)> withhold;  // true: the event is left out
    HostTime first;                                 // arrival of the recording's first event
    std::chrono::nanoseconds lead{0};               // from being ready until the first event
    std::function<bool()> stop;                     // looked at between events
  };
  // Reads until the queues are full or the recording ends, then plays. What was refused to the
  // threads is said in remarks().
  void play(RigEventSource& events, const Plan& plan);

  // By how much all times were moved; known once playing has begun.
  std::chrono::nanoseconds moved_by() const { return moved_by_; }
  PlayedCounts counts(DeviceKind device) const;
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  struct Line {
    explicit Line(PlayedDevice given) : device(std::move(given)), queue(device.events_ahead) {}
    PlayedDevice device;
    SpscQueue<RigEvent> queue;
    std::atomic<std::uint64_t> played{0};
    std::atomic<std::uint64_t> refused{0};
    std::atomic<int> last_errno{0};
    std::uint64_t withheld = 0;  // the reading thread's
    LatencyHistogram late;
    std::string remark;
    std::thread thread;
  };

  bool feed(RigEventSource& events, const Plan& plan);
  bool deal(const RigEvent& event, const Plan& plan);
  void start(const Plan& plan);
  void run(Line& line);
  void write(Line& line, const RigEvent& event, HostTime due) const;
  Line& line(DeviceKind device) { return *lines_[static_cast<std::size_t>(device)]; }

  std::array<std::unique_ptr<Line>, 3> lines_;
  std::chrono::nanoseconds moved_by_{0};
  bool started_ = false;
  std::atomic<bool> all_dealt_{false};
  std::atomic<bool> stopped_{false};
  std::vector<std::string> remarks_;
};

}  // namespace sparsight
