#include "realtime/sync/arrival_envelope.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr double kMostDrift = 200e-6;  // of a crystal, with a wide margin
constexpr std::size_t kMostVertices = 256;
constexpr int kEarlyToRestart = 5;
constexpr double kResidualMemory = 0.998;
constexpr std::size_t kSettledCount = 1000;
constexpr double kLeastMeanDelayNs = 200'000.0;

double ns(nanoseconds duration) { return static_cast<double>(duration.count()); }

}  // namespace

void ArrivalEnvelope::clear() {
  count_ = 0;
  sum_device_ns_ = 0.0;
  hull_.clear();
}

// The middle one of three is not on a lower hull.
bool ArrivalEnvelope::turns_right(const Point& a, const Point& b, const Point& c) {
  return (b.device_ns - a.device_ns) * (c.offset_ns - a.offset_ns) <=
         (b.offset_ns - a.offset_ns) * (c.device_ns - a.device_ns);
}

void ArrivalEnvelope::add(SensorTime device, HostTime arrival) {
  if (count_ == 0) {
    first_device_ = device;
    first_arrival_ = arrival;
  }
  const Point point{.device_ns = ns(device - first_device_),
                    .offset_ns = ns((arrival - first_arrival_) - (device - first_device_))};
  if (!hull_.empty() && point.device_ns <= hull_.back().device_ns) return;
  while (hull_.size() >= 2 && turns_right(hull_[hull_.size() - 2], hull_.back(), point)) {
    hull_.pop_back();
  }
  hull_.push_back(point);
  ++count_;
  sum_device_ns_ += point.device_ns;
  if (hull_.size() > kMostVertices) thin();
}

// Every second vertex makes a hull again, at most the little above that the others lay below.
void ArrivalEnvelope::thin() {
  std::size_t kept = 1;
  for (std::size_t i = 2; i + 1 < hull_.size(); i += 2) hull_[kept++] = hull_[i];
  hull_[kept++] = hull_.back();
  hull_.resize(kept);
}

std::optional<ClockLine> ArrivalEnvelope::line() const {
  if (hull_.empty()) return std::nullopt;
  const double mean = sum_device_ns_ / static_cast<double>(count_);
  std::size_t right = 0;
  while (right + 1 < hull_.size() && hull_[right].device_ns <= mean) ++right;
  double slope = 0.0;
  if (right > 0) {
    const Point& a = hull_[right - 1];
    const Point& b = hull_[right];
    slope = (b.offset_ns - a.offset_ns) / (b.device_ns - a.device_ns);
    slope = std::clamp(slope, -kMostDrift, kMostDrift);
  }
  // Where the slope had to be bent, the line touches another vertex than the edge's.
  double intercept = hull_[right].offset_ns - slope * hull_[right].device_ns;
  for (const Point& p : hull_) intercept = std::min(intercept, p.offset_ns - slope * p.device_ns);
  const Point& last = hull_.back();
  const auto at_last = nanoseconds(std::llround(last.device_ns));
  const auto offset = nanoseconds(std::llround(intercept + slope * last.device_ns));
  return ClockLine{.sensor = first_device_ + at_last,
                   .host = first_arrival_ + at_last + offset,
                   .rate = 1.0 + slope};
}

nanoseconds ArrivalEnvelope::span() const {
  return hull_.empty() ? nanoseconds(0) : nanoseconds(std::llround(hull_.back().device_ns));
}

void SlidingEnvelope::clear() {
  current_.clear();
  next_.clear();
  line_.reset();
  mean_residual_ns_ = kExpectedDelayNs;
  early_ = 0;
  block_empty_ = true;
  lifted_blocks_ = 0;
}

void SlidingEnvelope::restart() {
  ++restarts_;
  clear();
}

void SlidingEnvelope::add(SensorTime device, HostTime arrival) {
  if (line_) {
    const double residual = ns(arrival - line_->at(device));
    const bool impossible = residual < -ns(config_.step) && current_.count() > kSettledCount;
    if (impossible && ++early_ < kEarlyToRestart) return;
    if (impossible || stepped(residual, device)) restart();
    if (!impossible) early_ = 0;
    mean_residual_ns_ =
        kResidualMemory * mean_residual_ns_ + (1.0 - kResidualMemory) * std::max(0.0, residual);
  }
  current_.add(device, arrival);
  if (current_.span() >= config_.window / 2) next_.add(device, arrival);
  if (current_.span() >= config_.window) {
    std::swap(current_, next_);
    next_.clear();
  }
  line_ = current_.line();
}

// Whether for two blocks nothing has come near the line.
bool SlidingEnvelope::stepped(double residual_ns, SensorTime device) {
  if (block_empty_) {
    block_empty_ = false;
    block_start_ = device;
    least_in_block_ns_ = residual_ns;
  }
  least_in_block_ns_ = std::min(least_in_block_ns_, residual_ns);
  if (device - block_start_ < config_.block) return false;
  block_empty_ = true;
  lifted_blocks_ = least_in_block_ns_ > ns(config_.step) ? lifted_blocks_ + 1 : 0;
  return lifted_blocks_ >= 2;
}

nanoseconds SlidingEnvelope::mean_delay() const {
  return nanoseconds(std::llround(mean_residual_ns_));
}

// The least of n delays of mean m is about m / n; the line rests on a few such, and is used at the
// end of its span, not in the middle.
nanoseconds SlidingEnvelope::uncertainty() const {
  const double mean = std::max(mean_residual_ns_, kLeastMeanDelayNs);
  const double n = static_cast<double>(std::max<std::size_t>(1, current_.count()));
  return nanoseconds(std::llround(10.0 * mean / n));
}

}  // namespace sparsight
