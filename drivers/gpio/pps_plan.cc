#include "drivers/gpio/pps_plan.h"

#include <algorithm>

namespace sparsight {

PpsStep PpsPlan::next() const {
  const HostTime edge = first_edge_ + elapsed_;
  const UtcSecond second = second_ + elapsed_;
  switch (kind_) {
    case PpsStep::Kind::kFall:
      return {kind_, edge + kPpsPulse, second};
    case PpsStep::Kind::kSentence:
      return {kind_, edge + kSentenceAfterEdge, second};
    default:
      return {kind_, edge, second};
  }
}

void PpsPlan::done() {
  if (kind_ == PpsStep::Kind::kSentence) {
    kind_ = PpsStep::Kind::kRise;
    elapsed_ += std::chrono::seconds(1);
  } else {
    kind_ = kind_ == PpsStep::Kind::kRise ? PpsStep::Kind::kFall : PpsStep::Kind::kSentence;
  }
}

void PpsPlan::skip_to(HostTime now) {
  // A second whose edge was given is not begun again.
  const std::chrono::seconds earliest =
      elapsed_ + std::chrono::seconds(kind_ != PpsStep::Kind::kRise);
  kind_ = PpsStep::Kind::kRise;
  elapsed_ = std::max(earliest, std::chrono::ceil<std::chrono::seconds>(now - first_edge_));
}

PpsPlan plan_from(HostTime now, std::chrono::sys_time<std::chrono::nanoseconds> utc_now) {
  const auto second =
      std::chrono::ceil<std::chrono::seconds>(utc_now + std::chrono::milliseconds(500));
  return {now + (second - utc_now), second};
}

}  // namespace sparsight
