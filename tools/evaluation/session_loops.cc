#include "tools/evaluation/session_loops.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tools/evaluation/number_lines.h"
#include "tools/evaluation/text_file.h"

namespace sparsight {
namespace {

using nlohmann::json;

Eigen::Isometry3d pose_of(const std::vector<double>& t_q) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(t_q.at(0), t_q.at(1), t_q.at(2));
  const Eigen::Quaterniond q(t_q.at(6), t_q.at(3), t_q.at(4), t_q.at(5));
  T.linear() = q.normalized().toRotationMatrix();
  return T;
}

void take_session(const json& session, SessionLoops& out) {
  for (const json& loop : session.at("loops")) {
    if (loop.at("in_earlier_map").get<bool>()) {
      ++out.with_earlier_map;
      continue;
    }
    out.loops.push_back(
        {.frame = loop.at("frame"),
         .before = loop.at("seen_before_in_frame"),
         .T_frame_before = pose_of(loop.at("T_frame_before_tx_ty_tz_qx_qy_qz_qw"))});
  }
  for (const json& submap : session.at("submaps")) {
    out.submaps.push_back({.first_frame = submap.at("first_frame"), .part = submap.at("part")});
  }
}

// While it is lost every frame is offered as a keyframe; the one that was taken began a sub-map.
bool taken(std::uint64_t frame, bool lost, const SessionLoops& session) {
  return !lost || std::ranges::find(session.submaps, frame, &SessionLoops::Submap::first_frame) !=
                      session.submaps.end();
}

Result<void> take_frames(std::string text, const std::string& source, SessionLoops& out) {
  constexpr std::size_t kStatus = 2;
  constexpr std::size_t kKeyframe = 8;
  std::ranges::replace(text, ',', ' ');
  const std::vector<NumberLine> lines = split_number_lines(text);
  for (std::size_t i = 1; i < lines.size(); ++i) {  // after the line that names the columns
    const NumberLine& line = lines[i];
    if (line.fields.size() <= kKeyframe) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: {} fields; a frame has more than {}", source, line.number,
                              line.fields.size(), kKeyframe));
    }
    const auto sequence = parse_number(line, 0, source);
    if (!sequence) return tl::unexpected(sequence.error());
    const auto time = parse_seconds(line, 1, source);
    if (!time) return tl::unexpected(time.error());
    const auto frame = static_cast<std::uint64_t>(std::max(0.0, *sequence));
    out.exposures[frame] = HostTime(*time);
    if (line.fields[kKeyframe] == "1" && taken(frame, line.fields[kStatus] == "lost", out)) {
      out.keyframes.push_back(frame);
    }
  }
  return {};
}

}  // namespace

Result<SessionLoops> read_session_loops(const std::filesystem::path& folder) {
  const auto session = read_text_file(folder / "session.json");
  if (!session) return tl::unexpected(session.error());
  auto frames = read_text_file(folder / "frames.csv");
  if (!frames) return tl::unexpected(frames.error());
  SessionLoops result;
  try {
    take_session(json::parse(*session), result);
  } catch (const std::exception& error) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: {}", (folder / "session.json").string(), error.what()));
  }
  return take_frames(std::move(*frames), (folder / "frames.csv").string(), result).map([&] {
    return std::move(result);
  });
}

}  // namespace sparsight
