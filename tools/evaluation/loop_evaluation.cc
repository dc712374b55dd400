#include "tools/evaluation/loop_evaluation.h"

#include "tools/evaluation/part_error.h"

namespace sparsight {
namespace {

Result<std::optional<double>> ate_of(const std::filesystem::path& file, const Trajectory& truth,
                                     const PartsOfTime& parts) {
  if (truth.times.empty()) return std::nullopt;
  return read_trajectory(file, TrajectoryFormat::kTum).map([&](const Trajectory& path) {
    return part_error_m(path, truth, parts);
  });
}

}  // namespace

Result<LoopEvaluation> evaluate_loops(const std::filesystem::path& session_folder,
                                      const Trajectory& truth) {
  const auto session = read_session_loops(session_folder);
  if (!session) return tl::unexpected(session.error());
  const auto loops = loop_error(*session, truth, {});
  if (!loops) return tl::unexpected(loops.error());
  const auto odometry = ate_of(session_folder / "odometry.tum", truth, submaps_of_time(*session));
  if (!odometry) return tl::unexpected(odometry.error());
  const auto corrected =
      ate_of(session_folder / "trajectory.tum", truth, joined_parts_of_time(*session));
  if (!corrected) return tl::unexpected(corrected.error());
  return LoopEvaluation{*loops, *odometry, *corrected};
}

}  // namespace sparsight
