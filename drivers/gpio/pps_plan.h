#pragma once

#include <chrono>
#include <cstdint>

#include "drivers/gpio/nmea.h"
#include "hal/time.h"

namespace sparsight {

// The VLP-16's manual allows more; this satisfies the stricter HDL-32E's, too: a pulse of 20-200
// ms, the sentence 50-500 ms after its end.
inline constexpr std::chrono::nanoseconds kPpsPulse = std::chrono::milliseconds(50);
inline constexpr std::chrono::nanoseconds kSentenceAfterEdge = std::chrono::milliseconds(200);
inline constexpr std::chrono::nanoseconds kLatestSentence = std::chrono::milliseconds(250);
// A pulse that comes later makes the train unstable as much as one that does not come.
inline constexpr std::chrono::nanoseconds kLatestEdge = std::chrono::milliseconds(5);

struct PpsStep {
  enum class Kind : std::uint8_t { kRise, kFall, kSentence };
  Kind kind = Kind::kRise;
  HostTime at;
  UtcSecond second;  // that began at the rising edge
};

// What is to be done when, second after second: rise, fall, sentence. Counted from the first edge,
// so that no delay adds up and no second is named twice, whatever the time of day does meanwhile.
class PpsPlan {
 public:
  PpsPlan(HostTime first_edge, UtcSecond second) : first_edge_(first_edge), second_(second) {}

  PpsStep next() const;
  void done();
  // Goes on with the first second whose edge is not before `now`.
  void skip_to(HostTime now);

 private:
  HostTime first_edge_;
  UtcSecond second_;
  std::chrono::seconds elapsed_{0};
  PpsStep::Kind kind_ = PpsStep::Kind::kRise;
};

// The first second to begin at least half a second from now, given both clocks read at once.
PpsPlan plan_from(HostTime now, std::chrono::sys_time<std::chrono::nanoseconds> utc_now);

}  // namespace sparsight
