#include "drivers/datasets/sweep_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/frame_times.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

using Timestamps = std::vector<std::optional<HostTime>>;

// A turn is 50 to 200 ms; an offset of up to a second also fits LidarReturn::from_exposure_ns.
constexpr std::chrono::nanoseconds kLongestTurn = std::chrono::milliseconds(500);
// An image and the scan that triggered it: within half a turn.
constexpr std::chrono::nanoseconds kFarthestTrigger = std::chrono::milliseconds(50);

Result<Timestamps> read_timestamps(const fs::path& file) {
  return read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return parse_timestamps_utc(bytes, file.string()); });
}

// The line that belongs to each scan. Lines are numbered as scans are, except where a drive that
// misses scans has lines for the others only.
std::map<std::uint64_t, std::size_t> line_of_scan(const std::map<std::uint64_t, fs::path>& scans,
                                                  std::size_t lines) {
  const bool dense = scans.rbegin()->first >= lines && scans.size() == lines;
  std::map<std::uint64_t, std::size_t> line;
  for (const auto& [number, file] : scans) line[number] = dense ? line.size() : number;
  return line;
}

std::optional<HostTime> at_line(const Timestamps& times, std::size_t line) {
  return line < times.size() ? times[line] : std::nullopt;
}

}  // namespace

std::optional<HostTime> SweepFolder::trigger(std::uint64_t number) const {
  const auto known = times.find(number);
  return known == times.end() ? std::nullopt : known->second.trigger;
}

Result<SweepTiming> SweepFolder::timing(std::uint64_t number, HostTime exposure) const {
  const auto known = times.find(number);
  if (known == times.end() || !known->second.start || !known->second.end) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: no start or end time of scan {}", folder.string(), number));
  }
  const SweepTiming timing{*known->second.start, *known->second.end};
  const bool turn = timing.end > timing.start && timing.end - timing.start < kLongestTurn;
  const bool close = timing.start < exposure + kLongestTurn && timing.end > exposure - kLongestTurn;
  if (!turn || !close) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}: scan {} turns from {:+.6f} s to {:+.6f} s around its image's "
                            "exposure; that cannot be one turn",
                            folder.string(), number, to_seconds(timing.start - exposure),
                            to_seconds(timing.end - exposure)));
  }
  return timing;
}

std::optional<std::uint64_t> SweepFolder::nearest(HostTime arrival) const {
  std::optional<std::uint64_t> best;
  std::chrono::nanoseconds distance = kFarthestTrigger;
  for (const auto& [number, time] : times) {
    if (!time.trigger || std::chrono::abs(arrival - *time.trigger) >= distance) continue;
    distance = std::chrono::abs(arrival - *time.trigger);
    best = number;
  }
  return best;
}

Result<SweepFolder> read_sweep_folder(const fs::path& folder) {
  SweepFolder sweeps{folder, list_numbered_files(folder / "data", {".bin", ".txt"}), {}};
  if (sweeps.scans.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no scans; looked for data/NNNNNNNNNN.bin", folder.string()));
  }
  const auto starts = read_timestamps(folder / "timestamps_start.txt");
  if (!starts) return tl::unexpected(starts.error());
  const auto ends = read_timestamps(folder / "timestamps_end.txt");
  if (!ends) return tl::unexpected(ends.error());
  auto triggers = read_timestamps(folder / "timestamps.txt");
  if (!triggers && triggers.error().code == ErrorCode::kNotFound) triggers = Timestamps{};
  if (!triggers) return tl::unexpected(triggers.error());
  for (const auto& [number, line] : line_of_scan(sweeps.scans, starts->size())) {
    sweeps.times[number] = {at_line(*starts, line), at_line(*triggers, line), at_line(*ends, line)};
  }
  return sweeps;
}

}  // namespace sparsight
