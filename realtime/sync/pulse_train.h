#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "hal/time.h"

namespace sparsight {

struct PulseTrainConfig {
  std::size_t intervals_to_learn = 4;  // in a row, that agree, before a period is believed
  std::size_t pulses_in_fit = 32;
  double place = 0.2;         // share of the period by which a pulse may miss its place
  std::int64_t max_gap = 30;  // periods without a pulse; after a longer gap the count starts anew
};

struct Pulse {
  std::int64_t index = 0;  // counts periods, lost pulses included
  HostTime time;
  std::chrono::nanoseconds length{0};  // of what begins with it
  // Not to be taken at its word: incomplete, doubled, or off its place by more than the rest.
  bool doubtful = false;
  std::chrono::nanoseconds off{0};  // distance from its place
};

struct PulsePlace {
  HostTime time;
  std::chrono::nanoseconds sigma;
};

struct PulseCounters {
  std::uint64_t pulses = 0;
  std::uint64_t lost = 0;     // places left empty between two pulses
  std::uint64_t doubled = 0;  // second pulses at one place
  std::uint64_t strange = 0;  // far from any place
};

// Pulses of a steady period, numbered by a model of that period: each has its place whether or not
// it was seen. When the pulses stop fitting (pause, new phase, new period) the count starts anew
// and `generation` grows: indices of two generations do not compare. Bounded memory; thread-bound.
class PulseTrain {
 public:
  explicit PulseTrain(const PulseTrainConfig& config = {}) : config_(config) {}

  // In the order of their times.
  void add(HostTime time, std::chrono::nanoseconds length, bool doubtful);

  bool regular() const { return regular_; }  // a period is known; what follows is valid only then
  std::uint32_t generation() const { return generation_; }
  std::chrono::nanoseconds period() const;
  std::int64_t first_index() const { return 0; }
  std::int64_t last_index() const { return last_index_; }
  std::optional<Pulse> find(std::int64_t index) const;
  PulsePlace place_of(std::int64_t index) const;
  double index_at(HostTime time) const;  // by the model, with the share of the period
  // A pulse that fits no place lies within half a period of this one, which is empty: perhaps the
  // train has moved.
  bool disputed(std::int64_t index) const;
  std::chrono::nanoseconds length() const { return length_; }  // of a good pulse lately
  std::chrono::nanoseconds jitter() const;                     // one sigma around the model
  const PulseCounters& counters() const { return counters_; }

 private:
  struct Sample {
    std::int64_t index;
    HostTime time;
  };
  struct Sighting {
    HostTime time;
    std::chrono::nanoseconds length;
    std::chrono::nanoseconds since_previous;
  };

  void forget();
  void learn();
  void take(Pulse pulse);
  void doubt(std::int64_t index, std::chrono::nanoseconds off);
  bool estranged(HostTime time);
  void fit();

  PulseTrainConfig config_;
  bool regular_ = false;
  std::uint32_t generation_ = 0;
  std::int64_t last_index_ = 0;
  std::chrono::nanoseconds length_{0};
  std::optional<HostTime> newest_;
  std::deque<Sighting> lately_;  // good pulses of any place, to learn from
  std::deque<Sample> samples_;
  std::array<std::optional<Pulse>, 64> recent_;
  std::array<HostTime, 4> strangers_{};
  std::size_t stranger_count_ = 0;
  int strangeness_ = 0;
  // time = mean_time_ + period_ns_ * (index - mean_index_)
  HostTime mean_time_;
  double mean_index_ = 0.0;
  double period_ns_ = 0.0;
  double index_scatter_ = 0.0;  // sum of squared distances from mean_index_
  double sigma_ns_ = 0.0;
  PulseCounters counters_;
};

}  // namespace sparsight
