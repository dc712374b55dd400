#include "drivers/recording/state_messages.h"

#include "drivers/recording/cdr.h"

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

void write_time(HostTime time, CdrWriter& writer) {
  writer.number(std::int64_t{time.time_since_epoch().count()});
}

HostTime read_time(CdrReader& reader) {
  return HostTime(nanoseconds(reader.number<std::int64_t>()));
}

template <typename Enum>
void write_choice(Enum value, CdrWriter& writer) {
  writer.number(static_cast<std::uint8_t>(value));
}

// False for a number that none of the choices up to `last` has.
template <typename Enum>
bool read_choice(Enum last, CdrReader& reader, Enum& out) {
  const auto number = reader.number<std::uint8_t>();
  out = static_cast<Enum>(number);
  return number <= static_cast<std::uint8_t>(last);
}

}  // namespace

void append_edge(const Edge& edge, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_choice(edge.line, writer);
  writer.boolean(edge.rising);
  write_time(edge.time, writer);
}

bool read_edge(Bytes message, Edge& edge) {
  CdrReader reader(message);
  const bool known = read_choice(EdgeLine::kPps, reader, edge.line);
  edge.rising = reader.boolean();
  edge.time = read_time(reader);
  return known && reader.ok();
}

void append_device_state(const DeviceStateChange& change, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_choice(change.device, writer);
  write_choice(change.state, writer);
  write_time(change.at, writer);
}

bool read_device_state(Bytes message, DeviceStateChange& change) {
  CdrReader reader(message);
  const bool device = read_choice(DeviceKind::kTrigger, reader, change.device);
  const bool state = read_choice(DeviceState::kEnded, reader, change.state);
  change.at = read_time(reader);
  return device && state && reader.ok();
}

void append_sync_state(const RecordedSyncState& state, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  writer.number(state.frame_sequence);
  writer.number(state.frame_epoch);
  write_time(state.exposure_middle, writer);
  writer.number(std::int64_t{state.exposure_uncertainty.count()});
  write_choice(state.exposure_quality, writer);
  writer.boolean(state.lidar_clock.has_value());
  const RecordedLidarClock clock = state.lidar_clock.value_or(RecordedLidarClock{});
  writer.number(std::int64_t{clock.offset.count()});
  writer.number(clock.drift_ppm);
  writer.number(std::int64_t{clock.uncertainty.count()});
  writer.number(clock.epoch);
  write_choice(clock.quality, writer);
}

bool read_sync_state(Bytes message, RecordedSyncState& state) {
  CdrReader reader(message);
  state.frame_sequence = reader.number<std::uint32_t>();
  state.frame_epoch = reader.number<std::uint32_t>();
  state.exposure_middle = read_time(reader);
  state.exposure_uncertainty = nanoseconds(reader.number<std::int64_t>());
  const bool known = read_choice(StampQuality::kMeasured, reader, state.exposure_quality);
  const bool has_clock = reader.boolean();
  RecordedLidarClock clock;
  clock.offset = nanoseconds(reader.number<std::int64_t>());
  clock.drift_ppm = reader.number<double>();
  clock.uncertainty = nanoseconds(reader.number<std::int64_t>());
  clock.epoch = reader.number<std::uint32_t>();
  const bool clock_known = read_choice(StampQuality::kMeasured, reader, clock.quality);
  state.lidar_clock = has_clock ? std::optional(clock) : std::nullopt;
  return known && clock_known && reader.ok();
}

}  // namespace sparsight
