#include "tools/session/session_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/session/session_summary.h"

namespace sparsight {
namespace {

std::string accuracy_text(const Session& session) {
  if (!session.truth) return "";
  const Evaluation& evaluation = session.truth->evaluation;
  std::string text = "accuracy  ";
  if (evaluation.kitti.t_rel_percent && evaluation.kitti.r_rel_deg_per_m) {
    text += fmt::format("t_rel {:.2f} %, r_rel {:.4f} deg/m, ", *evaluation.kitti.t_rel_percent,
                        *evaluation.kitti.r_rel_deg_per_m);
  }
  return text + fmt::format("ATE {:.3f} m over {:.0f} m of true path ({})\n", evaluation.ate.rmse_m,
                            evaluation.path_length_m, session.truth->file.string());
}

std::string faults_text(const FaultLog& faults) {
  if (faults.count() == 0) return "";
  std::string kinds;
  for (const auto& [kind, count] : faults.count_by_kind()) {
    kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", count, kind);
  }
  return fmt::format("faults    {} in the source's data: {}\n", faults.count(), kinds);
}

std::string loss_text(const Session& session, const SessionSummary& summary) {
  if (summary.lost == 0) return "";
  const auto apart = std::ranges::count_if(session.submaps, [&](const Submap& submap) {
    return submap.part != session.submaps.front().part;
  });
  return fmt::format(
      "lost      {} frames in {} gaps; {} sub-maps, {} of them not joined to the first: where they "
      "lie is a guess\n",
      summary.lost, gaps_of(session.trajectory).size(), session.submaps.size(), apart);
}

std::string timing_text(const SessionSummary& summary) {
  return fmt::format(
      "speed     {:.1f} frames/s, {:.1f} x real time; tracking median {:.2f} ms, p99 {:.2f} ms; "
      "window median {:.1f} ms, p99 {:.1f} ms\n",
      summary.frames_per_s, summary.realtime_factor, summary.tracking.median_ms,
      summary.tracking.p99_ms, summary.window.median_ms, summary.window.p99_ms);
}

}  // namespace

std::string session_text(const Session& session, const std::filesystem::path& folder) {
  const SessionSummary summary = summarize(session);
  std::string text =
      fmt::format("frames    {} in {:.1f} s and {:.1f} m: {} tracked, {} predicted, {} keyframes\n",
                  summary.frames, summary.recorded_s, summary.path_length_m, summary.tracked,
                  summary.predicted, summary.keyframes);
  text += loss_text(session, summary);
  if (session.description.config.loop.enabled) {
    text += fmt::format("loops     {} closed, {} candidates verified\n", session.loops.size(),
                        session.loop_statistics.candidates);
  }
  text += accuracy_text(session) + timing_text(summary) + faults_text(session.faults);
  for (const std::string& note : session.notes) text += fmt::format("note      {}\n", note);
  return text + fmt::format("results   {}\n", folder.string());
}

}  // namespace sparsight
