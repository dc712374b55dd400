#include "tools/playback/recording_comparison.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "drivers/recording/recording_source.h"

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kSameEdge = std::chrono::milliseconds(2);

std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

struct HashedFrame {
  std::uint64_t hash = 0;
  HostTime stamp;
};

std::uint64_t hash_of(const CameraFrame& frame) {
  const std::uint64_t shape = (static_cast<std::uint64_t>(frame.width) << 32U) ^
                              (static_cast<std::uint64_t>(frame.height) << 8U) ^
                              static_cast<std::uint64_t>(frame.format);
  return hash_of(frame.bytes) ^ (shape * 0x9e3779b97f4a7c15ULL);
}

// All that is compared of a recording.
struct Contents {
  std::vector<HashedFrame> frames;
  std::vector<std::uint64_t> packets;
  std::vector<std::uint64_t> positions;
  std::vector<Edge> exposures;
  std::vector<Edge> pulses;
  std::uint32_t camera_starts = 0;
  std::uint64_t sequence_gaps = 0;
  std::optional<std::uint32_t> sequence;
  std::uint32_t epoch = 0;

  void operator()(const std::shared_ptr<const CameraFrame>& frame) {
    if (!sequence || frame->epoch != epoch) {
      ++camera_starts;
    } else {
      // A camera may count a frame twice, or wrap around.
      const auto step = static_cast<std::int32_t>(frame->sequence - *sequence);
      if (step > 1) sequence_gaps += static_cast<std::uint64_t>(step) - 1;
    }
    sequence = frame->sequence;
    epoch = frame->epoch;
    frames.push_back({hash_of(*frame), frame->driver_time});
  }
  void operator()(const LidarPacket& packet) { packets.push_back(hash_of(packet.payload)); }
  void operator()(const PositionPacket& packet) { positions.push_back(hash_of(packet.payload)); }
  void operator()(const Edge& edge) {
    if (edge.line == EdgeLine::kExposure) {
      exposures.push_back(edge);
    } else if (edge.rising) {
      pulses.push_back(edge);
    }
  }
  void operator()(const DeviceStateChange&) const {}
};

Contents contents_of(RigEventSource& source) {
  Contents contents;
  while (const auto event = source.next()) std::visit(contents, *event);
  return contents;
}

// Goes through both in their order; told of each pair that is equal.
template <typename T, typename Hash, typename Pair>
ContentComparison compare(const std::vector<T>& in, const std::vector<T>& out, Hash hash,
                          Pair pair) {
  ContentComparison result{.in = in.size(), .out = out.size()};
  auto next = in.begin();
  for (const T& one : out) {
    const auto found =
        std::find_if(next, in.end(), [&](const T& other) { return hash(other) == hash(one); });
    if (found == in.end()) {
      ++result.foreign;
      continue;
    }
    pair(*found, one);
    ++result.equal;
    next = found + 1;
  }
  result.missing = result.in - result.equal;
  return result;
}

ContentComparison compare(const std::vector<std::uint64_t>& in,
                          const std::vector<std::uint64_t>& out) {
  return compare(
      in, out, [](std::uint64_t hash) { return hash; }, [](std::uint64_t, std::uint64_t) {});
}

EdgeComparison compare(const std::vector<Edge>& in, const std::vector<Edge>& out,
                       nanoseconds moved_by) {
  EdgeComparison result{.in = in.size(), .out = out.size()};
  std::vector<nanoseconds> late;
  auto next = out.begin();
  for (const Edge& edge : in) {
    const HostTime due = edge.time + moved_by;
    while (next != out.end() && next->time < due - kSameEdge) ++next;
    if (next == out.end() || next->time > due + kSameEdge || next->rising != edge.rising) continue;
    late.push_back(next->time - due);
    ++next;
  }
  result.matched = late.size();
  if (late.empty()) return result;
  std::ranges::sort(late);
  result.median_late = late[late.size() / 2];
  result.most_late = late.back();
  result.least_late = late.front();
  return result;
}

}  // namespace

RecordingComparison compare_events(RigEventSource& in, RigEventSource& out, nanoseconds moved_by) {
  const Contents went_in = contents_of(in);
  const Contents came_out = contents_of(out);
  RecordingComparison result{.camera_starts = came_out.camera_starts,
                             .sequence_gaps = came_out.sequence_gaps};
  result.frames = compare(
      went_in.frames, came_out.frames, [](const HashedFrame& frame) { return frame.hash; },
      [&](const HashedFrame& before, const HashedFrame& after) {
        const nanoseconds error = std::chrono::abs(after.stamp - (before.stamp + moved_by));
        result.worst_frame_stamp = std::max(result.worst_frame_stamp, error);
      });
  result.packets = compare(went_in.packets, came_out.packets);
  result.positions = compare(went_in.positions, came_out.positions);
  result.exposures = compare(went_in.exposures, came_out.exposures, moved_by);
  result.pulses = compare(went_in.pulses, came_out.pulses, moved_by);
  return result;
}

Result<RecordingComparison> compare_recordings(const std::string& in, const std::string& out,
                                               nanoseconds moved_by) {
  auto went_in = RecordingSource::open(in);
  if (!went_in) return tl::unexpected(went_in.error());
  auto came_out = RecordingSource::open(out);
  if (!came_out) return tl::unexpected(came_out.error());
  return compare_events(**went_in, **came_out, moved_by);
}

}  // namespace sparsight
