#include "tools/playback/device_player.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "realtime/executor/loop_clock.h"
#include "realtime/executor/thread_setup.h"
#include "tools/playback/playback_faults.h"

namespace sparsight {
namespace {

// Between two looks at a queue that is full, or empty.
constexpr std::chrono::milliseconds kLookAgain{2};

}  // namespace

DevicePlayer::DevicePlayer(Devices devices) {
  for (std::size_t i = 0; i < devices.size(); ++i) {
    lines_[i] = std::make_unique<Line>(std::move(devices[i]));
  }
}

void DevicePlayer::play(RigEventSource& events, const Plan& plan) {
  const bool whole = feed(events, plan);
  if (!started_) start(plan);
  stopped_ = !whole;
  all_dealt_ = true;
  for (const auto& line : lines_) line->thread.join();
  for (const auto& line : lines_) {
    if (!line->remark.empty()) remarks_.push_back(line->remark);
  }
}

// False if it was asked to stop.
bool DevicePlayer::feed(RigEventSource& events, const Plan& plan) {
  while (const auto event = events.next()) {
    if (std::holds_alternative<DeviceStateChange>(*event)) continue;
    if (plan.withhold && plan.withhold(*event)) {
      ++line(device_of(*event)).withheld;
      continue;
    }
    if (!deal(*event, plan)) return false;
  }
  return true;
}

// The first queue that is full has them all start.
bool DevicePlayer::deal(const RigEvent& event, const Plan& plan) {
  auto queue = line(device_of(event)).queue.producer();
  while (!queue.try_push(event)) {
    if (!started_) start(plan);
    if (plan.stop && plan.stop()) return false;
    std::this_thread::sleep_for(kLookAgain);
  }
  return !(plan.stop && plan.stop());
}

void DevicePlayer::start(const Plan& plan) {
  started_ = true;
  moved_by_ = HostClock::now() + plan.lead - plan.first;
  for (const auto& line : lines_) {
    line->thread = std::thread([this, &line] { run(*line); });
  }
}

void DevicePlayer::run(Line& line) {
  ThreadSettings settings{.name = line.device.name};
  if (line.device.fifo_priority > 0) settings.fifo_priority = line.device.fifo_priority;
  line.remark = set_up_thread(settings).value_or("");
  MonotonicClock clock;
  RigEvent event;
  while (!stopped_) {
    // In this order: what was dealt before the last look is in the queue by now.
    const bool last_look = all_dealt_;
    if (!line.queue.consumer().try_pop(event)) {
      if (last_look) return;
      std::this_thread::sleep_for(kLookAgain);
      continue;
    }
    const HostTime due = arrival_of(event) + moved_by_;
    clock.sleep_until(due);
    line.late.add(clock.now() - due);
    write(line, event, due);
  }
}

void DevicePlayer::write(Line& line, const RigEvent& event, HostTime due) const {
  const int status = line.device.write(event, due);
  if (status == 0) {
    ++line.played;
    return;
  }
  ++line.refused;
  line.last_errno = -status;
}

PlayedCounts DevicePlayer::counts(DeviceKind device) const {
  const Line& line = *lines_[static_cast<std::size_t>(device)];
  return {.played = line.played,
          .withheld = line.withheld,
          .refused = line.refused,
          .last_errno = line.last_errno,
          .late = line.late.snapshot()};
}

}  // namespace sparsight
