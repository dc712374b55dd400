#include "realtime/sync/pulse_train.h"

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr double kAgreement = 0.02;        // of intervals, while learning
constexpr double kCrowded = 0.5;           // of the period, between pulses
constexpr double kSigmasOff = 6.0;         // farther from its place a pulse is doubtful,
constexpr double kLeastOffNs = 200'000.0;  // unless it is this near
constexpr nanoseconds kFarBack{1'000'000'000};
constexpr double kLeastSigmaNs = 1'000.0;
// Two points for a pulse that does not fit, one back for one that does: three in a row, or every
// second one, end the train; a single glitch does not.
constexpr int kStrange = 2;
constexpr int kEstranged = 6;

double count_of(nanoseconds duration) { return static_cast<double>(duration.count()); }
nanoseconds rounded(double ns) { return nanoseconds(std::llround(ns)); }

}  // namespace

nanoseconds PulseTrain::period() const { return rounded(period_ns_); }
nanoseconds PulseTrain::jitter() const { return rounded(sigma_ns_); }

void PulseTrain::add(HostTime time, nanoseconds length, bool doubtful) {
  ++counters_.pulses;
  if (newest_ && *newest_ - time > kFarBack) {
    // The one before was in the future, or a recording's clock was set back.
    lately_.clear();
    newest_.reset();
    if (regular_) forget();
  }
  if (newest_ && time <= *newest_) {
    ++counters_.doubled;
    return;
  }
  const nanoseconds since_previous = newest_ ? time - *newest_ : nanoseconds::max();
  newest_ = time;
  if (!doubtful) {
    lately_.push_back({time, length, since_previous});
    if (lately_.size() > config_.intervals_to_learn + 1) lately_.pop_front();
  }
  if (!regular_) {
    if (!doubtful) learn();
    return;
  }
  const auto index = static_cast<std::int64_t>(std::llround(index_at(time)));
  const nanoseconds off = time - place_of(index).time;
  const bool in_place = std::abs(count_of(off)) < config_.place * period_ns_;
  if (index - last_index_ > config_.max_gap) return forget();
  if (in_place && index > last_index_) {
    return take({.index = index, .time = time, .length = length, .doubtful = doubtful, .off = off});
  }
  ++(in_place ? counters_.doubled : counters_.strange);
  // Where a pulse stands that does not belong, its neighbour may be cut short, or be the wrong one.
  doubt(last_index_, in_place ? off : nanoseconds(0));
  if (!in_place && !doubtful && estranged(time)) forget();
}

void PulseTrain::forget() {
  regular_ = false;
  recent_.fill(std::nullopt);
  samples_.clear();
  stranger_count_ = 0;
  strangeness_ = 0;
  // Of what came before a pause nothing is left to learn from.
  std::erase_if(lately_, [&](const Sighting& s) {
    return count_of(*newest_ - s.time) > static_cast<double>(config_.max_gap) * period_ns_;
  });
  learn();
}

void PulseTrain::learn() {
  if (lately_.size() <= config_.intervals_to_learn) return;
  const double mean = count_of(lately_.back().time - lately_.front().time) /
                      static_cast<double>(config_.intervals_to_learn);
  for (std::size_t i = 0; i < lately_.size(); ++i) {
    if (count_of(lately_[i].length) >= mean) return;
    const double place = static_cast<double>(i) * mean;
    if (std::abs(count_of(lately_[i].time - lately_[0].time) - place) > kAgreement * mean) return;
  }
  regular_ = true;
  ++generation_;
  for (std::size_t i = 0; i < lately_.size(); ++i) {
    const Sighting& seen = lately_[i];
    last_index_ = static_cast<std::int64_t>(i);
    // The first may itself be the second of two at one place.
    const bool doubtful = count_of(seen.since_previous) < kCrowded * mean;
    recent_[i] =
        Pulse{.index = last_index_, .time = seen.time, .length = seen.length, .doubtful = doubtful};
    if (!doubtful) samples_.push_back({last_index_, seen.time});
  }
  length_ = lately_.back().length;
  fit();
}

void PulseTrain::take(Pulse pulse) {
  counters_.lost += static_cast<std::uint64_t>(pulse.index - last_index_ - 1);
  // Only now that the next has come is it sure that nothing was wrong with the last one.
  if (const auto last = find(last_index_); last && !last->doubtful) length_ = last->length;
  last_index_ = pulse.index;
  const bool off = std::abs(count_of(pulse.off)) > std::max(kSigmasOff * sigma_ns_, kLeastOffNs);
  // A train whose pulses are all off has moved.
  if (off && !pulse.doubtful && estranged(pulse.time)) return forget();
  // Two that run into one another have lost what was between them.
  pulse.doubtful |= off || count_of(pulse.length) >= period_ns_;
  recent_[static_cast<std::size_t>(pulse.index) % recent_.size()] = pulse;
  if (pulse.doubtful) return;
  strangeness_ = std::max(0, strangeness_ - 1);
  samples_.push_back({pulse.index, pulse.time});
  if (samples_.size() > config_.pulses_in_fit) samples_.pop_front();
  fit();
}

void PulseTrain::doubt(std::int64_t index, nanoseconds off) {
  auto& slot = recent_[static_cast<std::size_t>(index) % recent_.size()];
  if (!slot || slot->index != index) return;
  slot->doubtful = true;
  slot->off = std::max(std::chrono::abs(slot->off), std::chrono::abs(off));
}

bool PulseTrain::estranged(HostTime time) {
  strangers_[stranger_count_++ % strangers_.size()] = time;
  strangeness_ += kStrange;
  return strangeness_ >= kEstranged;
}

void PulseTrain::fit() {
  const auto n = static_cast<double>(samples_.size());
  const Sample& first = samples_.front();
  double sum_index = 0.0;
  double sum_time = 0.0;
  for (const Sample& s : samples_) {
    sum_index += static_cast<double>(s.index - first.index);
    sum_time += count_of(s.time - first.time);
  }
  const double middle = sum_index / n;
  index_scatter_ = 0.0;
  double product = 0.0;
  for (const Sample& s : samples_) {
    const double x = static_cast<double>(s.index - first.index) - middle;
    index_scatter_ += x * x;
    product += x * (count_of(s.time - first.time) - sum_time / n);
  }
  period_ns_ = product / index_scatter_;
  mean_index_ = static_cast<double>(first.index) + middle;
  mean_time_ = first.time + rounded(sum_time / n);
  double squares = 0.0;
  for (const Sample& s : samples_) {
    const double expected = period_ns_ * (static_cast<double>(s.index) - mean_index_);
    squares += std::pow(count_of(s.time - mean_time_) - expected, 2);
  }
  sigma_ns_ = std::max(kLeastSigmaNs, std::sqrt(squares / std::max(1.0, n - 2.0)));
}

double PulseTrain::index_at(HostTime time) const {
  return mean_index_ + count_of(time - mean_time_) / period_ns_;
}

PulsePlace PulseTrain::place_of(std::int64_t index) const {
  const double from_mean = static_cast<double>(index) - mean_index_;
  const double n = static_cast<double>(samples_.size());
  // What the line does not know, and what the pulse itself strays from it.
  const double variance = 1.0 + 1.0 / n + from_mean * from_mean / index_scatter_;
  return {.time = mean_time_ + rounded(period_ns_ * from_mean),
          .sigma = rounded(sigma_ns_ * std::sqrt(variance))};
}

std::optional<Pulse> PulseTrain::find(std::int64_t index) const {
  if (index < 0) return std::nullopt;
  const auto& slot = recent_[static_cast<std::size_t>(index) % recent_.size()];
  return slot && slot->index == index ? slot : std::nullopt;
}

bool PulseTrain::disputed(std::int64_t index) const {
  if (find(index)) return false;
  const HostTime place = place_of(index).time;
  const auto known = std::min(stranger_count_, strangers_.size());
  return std::any_of(strangers_.begin(), strangers_.begin() + known, [&](HostTime stranger) {
    return std::abs(count_of(stranger - place)) < 0.5 * period_ns_;
  });
}

}  // namespace sparsight
