#include "drivers/recording/ros_header.h"

#include <algorithm>
#include <limits>

namespace sparsight {

using std::chrono::nanoseconds;
using std::chrono::seconds;

void write_stamp(HostTime time, CdrWriter& writer) {
  const auto whole = std::chrono::floor<seconds>(time.time_since_epoch());
  const auto clamped =
      std::clamp<seconds::rep>(whole.count(), std::numeric_limits<std::int32_t>::min(),
                               std::numeric_limits<std::int32_t>::max());
  writer.number(static_cast<std::int32_t>(clamped));
  writer.number(static_cast<std::uint32_t>((time.time_since_epoch() - whole).count()));
}

HostTime read_stamp(CdrReader& reader) {
  const seconds whole(reader.number<std::int32_t>());
  return HostTime(whole + nanoseconds(reader.number<std::uint32_t>()));
}

void write_header(const RosHeader& header, CdrWriter& writer) {
  write_stamp(header.stamp, writer);
  writer.text(header.frame_id);
}

RosHeader read_header(CdrReader& reader) {
  const HostTime stamp = read_stamp(reader);
  return {stamp, reader.text()};
}

}  // namespace sparsight
