#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/recording/recorder.h"
#include "realtime/pipeline/live_status.h"

namespace sparsight {

// A live run as it is shown once a second: what happened since the look before, and in all.
struct LiveView {
  LiveStatus now;
  LiveStatus before;
  std::optional<RecorderReport> recorder;
  double cpu_share = 0.0;  // processor time over wall time, since the look before
  std::uint64_t resident_bytes = 0;
};

// One line for a person.
std::string live_line(const LiveView& view);
// One line of JSON, for machines; latencies in milliseconds, over the last second.
std::string live_json(const LiveView& view);

const char* name_of(RecorderState state);

}  // namespace sparsight
