#include "realtime/sync/edge_matcher.h"

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr int kDelayBlock = 64;     // frames; the least delay is that of one to two blocks
constexpr double kNearLeast = 0.1;  // of the period
constexpr double kExcessMemory = 0.98;
constexpr nanoseconds kMostDriverLag{2'000'000'000};
constexpr nanoseconds kMostExposure{10'000'000'000};
constexpr nanoseconds kUnknownTime{33'000'000};  // about a period

// A driver that stamps on another clock, or not at all, leaves the arrival.
HostTime time_of(const CameraFrame& frame) {
  const bool plausible =
      frame.driver_time <= frame.arrival && frame.driver_time > frame.arrival - kMostDriverLag;
  return plausible ? frame.driver_time : frame.arrival;
}

// Zero where it is not known, or cannot be.
nanoseconds exposure_of(const CameraFrame& frame) {
  const bool plausible = frame.exposure > nanoseconds(0) && frame.exposure < kMostExposure;
  return plausible ? frame.exposure : nanoseconds(0);
}

}  // namespace

EdgeMatcher::EdgeMatcher(const EdgeMatcherConfig& config)
    : config_(config), pairing_(config.exposure_active) {}

void EdgeMatcher::add(const Edge& edge) {
  if (const auto mark = pairing_.add(edge)) {
    train_.add(mark->start, mark->length, mark->doubtful);
  }
}

void EdgeMatcher::add(Frame frame, std::vector<StampedFrame>& out) {
  ++counts_.frames;
  if (!follows(*frame, out)) return emit_unsynchronized(frame, out);
  if (!train_.regular() || train_.generation() != generation_) {
    offset_.reset();
    generation_ = train_.generation();
  }
  if (!offset_) return hold(std::move(frame), out);
  const nanoseconds delay = delay_of(*frame, *offset_);
  switch (fit(delay)) {
    case Fit::kGood:
      counts_.frames_late += held_.size();
      for (const Frame& late : held_) emit(late, out);
      held_.clear();
      learn_delay(delay);
      return emit(frame, out);
    case Fit::kEarly:
      // Impossible, so the association was wrong, and what was learned by it with it.
      finish(out);
      offset_.reset();
      least_before_ = least_now_ = std::nullopt;
      return hold(std::move(frame), out);
    case Fit::kLate:
      return hold(std::move(frame), out);
  }
}

// Whether the frame's number continues the count; a new count ends the association.
bool EdgeMatcher::follows(const CameraFrame& frame, std::vector<StampedFrame>& out) {
  const bool same_stream = last_sequence_ && frame.epoch == camera_epoch_;
  if (same_stream && frame.sequence == *last_sequence_) return false;  // delivered twice
  if (same_stream && frame.sequence > *last_sequence_) {
    counts_.frames_lost += frame.sequence - *last_sequence_ - 1;
  } else if (last_sequence_) {
    finish(out);
    offset_.reset();
  }
  camera_epoch_ = frame.epoch;
  last_sequence_ = frame.sequence;
  return exposure_fits(frame);
}

void EdgeMatcher::hold(Frame frame, std::vector<StampedFrame>& out) {
  held_.push_back(std::move(frame));
  if (held_.size() >= config_.frames_to_accept) associate(out);
}

// All places are taken: either the held frames agree on an association, or the oldest gives up.
void EdgeMatcher::associate(std::vector<StampedFrame>& out) {
  offset_ = train_.regular() ? common_offset() : std::nullopt;
  if (!offset_) {
    emit_unsynchronized(held_.front(), out);
    held_.pop_front();
    return;
  }
  ++counts_.associations;
  least_before_ = least_now_ = std::nullopt;
  // They vouch for those to come, not for themselves: a few frames that were all late, before the
  // count slipped by as much, look like the first of those after it.
  for (const Frame& frame : held_) {
    learn_delay(delay_of(*frame, *offset_));
    emit_unsynchronized(frame, out);
  }
  held_.clear();
}

// How many periods too long the delay is. Of a camera seen before, its usual delay says so, if
// that fits at all; otherwise min_frame_delay does.
std::int64_t EdgeMatcher::whole_periods(nanoseconds delay) const {
  const double period = static_cast<double>(train_.period().count());
  if (const auto usual = least_delay()) {
    const double periods = static_cast<double>((delay - *usual).count()) / period;
    if (std::abs(periods - std::round(periods)) < config_.max_spread) return std::llround(periods);
  }
  return static_cast<std::int64_t>(
      std::floor(static_cast<double>((delay - config_.min_frame_delay).count()) / period));
}

std::optional<std::int64_t> EdgeMatcher::common_offset() const {
  const auto middle = static_cast<std::int64_t>(std::floor(train_.index_at(time_of(*held_[0]))));
  const std::int64_t offset = middle - static_cast<std::int64_t>(held_[0]->sequence);
  std::vector<nanoseconds> delays;
  delays.reserve(held_.size());
  for (const Frame& frame : held_) delays.push_back(delay_of(*frame, offset));
  const nanoseconds least = *std::min_element(delays.begin(), delays.end());
  const nanoseconds most = *std::max_element(delays.begin(), delays.end());
  const double period = static_cast<double>(train_.period().count());
  if (static_cast<double>((most - least).count()) >= config_.max_spread * period) {
    return std::nullopt;
  }
  // Most are about as fast as the fastest: it is no stray.
  const auto fast = std::count_if(delays.begin(), delays.end(), [&](nanoseconds delay) {
    return static_cast<double>((delay - least).count()) < kNearLeast * period;
  });
  const std::int64_t found = offset + whole_periods(least);
  const auto seen = std::count_if(held_.begin(), held_.end(), [&](const Frame& frame) {
    return train_.find(static_cast<std::int64_t>(frame->sequence) + found).has_value();
  });
  const auto half = static_cast<std::ptrdiff_t>(held_.size() / 2);
  if (fast < half || seen < half) return std::nullopt;
  return found;
}

EdgeMatcher::Fit EdgeMatcher::fit(nanoseconds delay) const {
  const double excess = static_cast<double>((delay - least_delay().value_or(delay)).count());
  const double tolerance = config_.max_spread * static_cast<double>(train_.period().count());
  if (excess < -tolerance) return Fit::kEarly;
  return excess < tolerance ? Fit::kGood : Fit::kLate;
}

nanoseconds EdgeMatcher::delay_of(const CameraFrame& frame, std::int64_t offset) const {
  const std::int64_t index = static_cast<std::int64_t>(frame.sequence) + offset;
  // The place, not the pulse: it is there for lost ones too, and knows no outliers.
  const nanoseconds length = length_of(frame, index);
  return time_of(frame) - (train_.place_of(index).time + delay_of_trigger() + length);
}

// Of the exposure: as its edges have it, or else as the camera says.
nanoseconds EdgeMatcher::length_of(const CameraFrame& frame, std::int64_t index) const {
  if (!config_.exposure_active) return exposure_of(frame);
  const std::optional<Pulse> pulse = train_.find(index);
  if (pulse && !pulse->doubtful) return pulse->length;
  return exposure_of(frame) > nanoseconds(0) ? exposure_of(frame) : train_.length();
}

nanoseconds EdgeMatcher::delay_of_trigger() const {
  return config_.exposure_active ? nanoseconds(0) : config_.trigger_delay;
}

std::optional<nanoseconds> EdgeMatcher::least_delay() const {
  if (!least_now_ || !least_before_) return least_now_ ? least_now_ : least_before_;
  return std::min(*least_now_, *least_before_);
}

void EdgeMatcher::learn_delay(nanoseconds delay) {
  least_now_ = std::min(least_now_.value_or(delay), delay);
  if (++in_block_ >= kDelayBlock) {
    least_before_ = least_now_;
    least_now_.reset();
    in_block_ = 0;
  }
  const auto excess = static_cast<double>((delay - *least_delay()).count());
  mean_excess_ns_ = kExcessMemory * mean_excess_ns_ + (1.0 - kExcessMemory) * excess;
}

// A sensor that is still exposing ignores the next trigger: which of them made a frame is unknown.
bool EdgeMatcher::exposure_fits(const CameraFrame& frame) const {
  return config_.exposure_active || !train_.regular() || exposure_of(frame) < train_.period();
}

std::optional<Stamp> EdgeMatcher::stamp_of(const CameraFrame& frame) const {
  const std::int64_t index = static_cast<std::int64_t>(frame.sequence) + *offset_;
  const std::optional<Pulse> pulse = train_.find(index);
  const PulsePlace place = train_.place_of(index);
  if (index < train_.first_index() || train_.disputed(index)) return std::nullopt;
  Stamp stamp{.arrival = frame.arrival, .epoch = counts_.associations};
  if (pulse && !pulse->doubtful) {
    stamp.mapped = pulse->time;
    // The mean of two edges is better than one.
    stamp.uncertainty = config_.exposure_active ? config_.edge_sigma * 7 / 10 : config_.edge_sigma;
    stamp.quality = StampQuality::kMeasured;
  } else {
    stamp.mapped = place.time;
    stamp.uncertainty = std::max(place.sigma, config_.edge_sigma);
    if (pulse) stamp.uncertainty = std::max(stamp.uncertainty, std::chrono::abs(pulse->off));
    stamp.quality = StampQuality::kEstimated;
  }
  if (!config_.exposure_active && exposure_of(frame) == nanoseconds(0)) {
    stamp.uncertainty += train_.period() / 4;  // somewhere between the trigger and the next
    stamp.quality = StampQuality::kEstimated;
  }
  stamp.mapped += delay_of_trigger() + length_of(frame, index) / 2;
  if (last_mapped_ && stamp.mapped <= *last_mapped_) return std::nullopt;
  return stamp;
}

void EdgeMatcher::emit(const Frame& frame, std::vector<StampedFrame>& out) {
  const std::optional<Stamp> stamp = stamp_of(*frame);
  if (!stamp) return emit_unsynchronized(frame, out);
  ++(stamp->quality == StampQuality::kMeasured ? counts_.edges_matched : counts_.frames_estimated);
  last_mapped_ = stamp->mapped;
  out.push_back({.frame = frame, .stamp = *stamp});
}

void EdgeMatcher::emit_unsynchronized(const Frame& frame, std::vector<StampedFrame>& out) {
  ++counts_.frames_unsynchronized;
  out.push_back({.frame = frame,
                 .stamp = {.arrival = frame->arrival,
                           .mapped = time_of(*frame),
                           .uncertainty = train_.regular() ? train_.period() : kUnknownTime,
                           .epoch = counts_.associations,
                           .quality = StampQuality::kArrival}});
}

void EdgeMatcher::finish(std::vector<StampedFrame>& out) {
  for (const Frame& frame : held_) emit_unsynchronized(frame, out);
  held_.clear();
}

CameraSyncState EdgeMatcher::state() const {
  CameraSyncState state = counts_;
  state.locked = offset_.has_value();
  state.edges_lost = train_.counters().lost + pairing_.incomplete();
  state.edges_doubled = train_.counters().doubled + train_.counters().strange;
  if (train_.regular()) {
    state.period = train_.period();
    state.edge_jitter = train_.jitter();
  }
  state.delay = least_delay().value_or(nanoseconds(0));
  state.delay_spread = nanoseconds(std::llround(mean_excess_ns_));
  return state;
}

}  // namespace sparsight
