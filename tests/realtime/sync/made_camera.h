#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "hal/rig_event.h"

namespace sparsight {

struct MadeCameraOptions {
  bool exposure_active = true;
  std::chrono::nanoseconds period{33'333'000};
  std::chrono::nanoseconds exposure{5'000'000};
  std::chrono::nanoseconds trigger_delay{100'000};
  std::chrono::nanoseconds readout{12'000'000};
  double edge_jitter_ns = 20'000;
  double mean_delay_ns = 500'000;  // exponential; one frame in 50 takes 5 ms more
  unsigned seed = 1;
};

// What goes wrong with one trigger.
struct MadeFault {
  bool lose_rise = false;
  bool lose_fall = false;
  bool lose_frame = false;                     // with a gap in the sequence
  bool ignore_trigger = false;                 // the sensor makes no frame, and counts none
  std::chrono::nanoseconds late{0};            // of the frame
  std::chrono::nanoseconds glitch_at{0};       // the line changes shortly, this far after the start
  std::chrono::nanoseconds second_rise_at{0};  // a repeated rise
};

// A triggered camera and its line, with the truth.
class MadeCamera {
 public:
  explicit MadeCamera(const MadeCameraOptions& options = {})
      : options_(options), random_(options.seed) {}

  void shoot(const MadeFault& fault = {}) {
    const HostTime trigger = now_;
    const HostTime start =
        trigger + (options_.exposure_active ? std::chrono::nanoseconds(0) : options_.trigger_delay);
    now_ += options_.period;
    if (!fault.lose_rise) edge(true, trigger);
    if (options_.exposure_active && !fault.lose_fall) edge(false, start + options_.exposure);
    if (fault.glitch_at.count() != 0) {
      const bool within = options_.exposure_active && fault.glitch_at < options_.exposure;
      put({EdgeLine::kExposure, !within, trigger + fault.glitch_at});
      put({EdgeLine::kExposure, within, trigger + fault.glitch_at + std::chrono::microseconds(20)});
    }
    if (fault.second_rise_at.count() != 0) {
      put({EdgeLine::kExposure, true, trigger + fault.second_rise_at});
    }
    if (fault.ignore_trigger) return;
    const std::uint32_t sequence = sequence_++;
    if (!fault.lose_frame) deliver(sequence, start, fault.late);
  }
  void shoot_many(int count, const MadeFault& fault = {}) {
    for (int i = 0; i < count; ++i) shoot(fault);
  }
  void pause(std::chrono::nanoseconds duration) { now_ += duration; }
  void restart(bool new_epoch) {
    if (new_epoch) ++epoch_;
    sequence_ = 0;
  }
  void set_exposure(std::chrono::nanoseconds exposure) { options_.exposure = exposure; }

  void set_damaged(bool damaged) { damaged_ = damaged; }

  std::vector<RigEvent> events() const {
    std::vector<RigEvent> sorted = events_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const RigEvent& a, const RigEvent& b) {
      return arrival_of(a) < arrival_of(b);
    });
    return sorted;
  }
  HostTime middle_of(const CameraFrame& frame) const { return middles_.at(&frame); }
  HostTime now() const { return now_; }
  std::size_t frames() const { return middles_.size(); }

 private:
  void edge(bool rising, HostTime time) {
    std::normal_distribution<double> jitter(0.0, options_.edge_jitter_ns);
    put({EdgeLine::kExposure, rising,
         time + std::chrono::nanoseconds(static_cast<std::int64_t>(jitter(random_)))});
  }
  void put(const Edge& edge) { events_.emplace_back(edge); }

  void deliver(std::uint32_t sequence, HostTime start, std::chrono::nanoseconds late) {
    std::exponential_distribution<double> delay(1.0 / options_.mean_delay_ns);
    const bool slow = std::uniform_int_distribution(0, 49)(random_) == 0;
    HostTime time = start + options_.exposure + options_.readout + late +
                    std::chrono::nanoseconds(static_cast<std::int64_t>(delay(random_))) +
                    std::chrono::milliseconds(slow ? 5 : 0);
    time = std::max(time, last_delivered_ + std::chrono::microseconds(100));
    last_delivered_ = time;
    auto frame = std::make_shared<CameraFrame>();
    frame->sequence = sequence;
    frame->epoch = epoch_;
    frame->driver_time = time;
    frame->arrival = time + std::chrono::microseconds(50);
    frame->exposure = options_.exposure;
    frame->damaged = damaged_;
    frame->width = 4;
    frame->height = 2;
    frame->stride_bytes = 4;
    frame->bytes.assign(8, static_cast<std::uint8_t>(sequence));
    middles_[frame.get()] = start + options_.exposure / 2;
    events_.emplace_back(std::move(frame));
  }

  MadeCameraOptions options_;
  std::mt19937 random_;
  HostTime now_{std::chrono::seconds(1000)};
  HostTime last_delivered_{};
  std::uint32_t sequence_ = 0;
  std::uint32_t epoch_ = 0;
  bool damaged_ = false;
  std::vector<RigEvent> events_;
  std::map<const CameraFrame*, HostTime> middles_;
};

}  // namespace sparsight
