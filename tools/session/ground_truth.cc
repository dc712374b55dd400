#include "tools/session/ground_truth.h"

#include <fmt/format.h>

#include "tools/evaluation/association.h"
#include "tools/session/open_source.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

constexpr double kShortPath_m = 200.0;

Trajectory estimate_of(const std::vector<TrajectoryPose>& trajectory, bool with_times) {
  Trajectory estimate{.source = "trajectory"};
  for (const TrajectoryPose& pose : trajectory) {
    if (with_times && !pose.known) continue;  // without times, place in the file is all there is
    estimate.poses.push_back(pose.T_world_camera);
    if (with_times) estimate.times.push_back(pose.exposure);
  }
  return estimate;
}

std::vector<Eigen::Vector3d> positions_in_world(const Trajectory& estimate, const Trajectory& truth,
                                                const std::vector<IndexPair>& pairs) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(pairs.size());
  const Eigen::Isometry3d T_world_truth =
      estimate.poses[pairs.front().estimate] * truth.poses[pairs.front().truth].inverse();
  for (const IndexPair& pair : pairs) {
    positions.emplace_back(T_world_truth * truth.poses[pair.truth].translation());
  }
  return positions;
}

}  // namespace

std::optional<fs::path> find_ground_truth(const fs::path& source, int camera) {
  if (camera != 0) return std::nullopt;
  std::error_code error;
  const fs::path folder = fs::canonical(source, error);
  if (error) return std::nullopt;
  const fs::path beside = fs::path(folder).replace_extension("ground_truth.tum");
  if (is_recording(folder)) {
    return fs::is_regular_file(beside, error) ? std::optional(beside) : std::nullopt;
  }
  const fs::path odometry =
      folder.parent_path().parent_path() / "poses" / (folder.filename().string() + ".txt");
  const fs::path inside = folder / "poses_camera_0.txt";
  const fs::path of_capture = folder / "ground_truth.tum";
  if (fs::is_regular_file(inside, error)) return inside;
  if (fs::is_regular_file(of_capture, error)) return of_capture;
  if (fs::is_regular_file(odometry, error)) return odometry;
  return std::nullopt;
}

Result<GroundTruth> compare_with_ground_truth(const std::vector<TrajectoryPose>& trajectory,
                                              const fs::path& file) {
  auto truth = read_trajectory(file);
  if (!truth) return tl::unexpected(truth.error());
  const Trajectory estimate = estimate_of(trajectory, !truth->times.empty());
  EvaluationOptions options;
  auto evaluation = evaluate_trajectories(estimate, *truth, options);
  if (evaluation && evaluation->path_length_m <= kShortPath_m) {
    options.segments.lengths_m = {10, 20, 30, 40, 50};
    evaluation = evaluate_trajectories(estimate, *truth, options);
  }
  if (!evaluation) return tl::unexpected(evaluation.error());
  const auto pairs = associate(estimate, *truth, options.max_time_difference);
  if (!pairs) return tl::unexpected(pairs.error());
  return GroundTruth{file, *std::move(evaluation), positions_in_world(estimate, *truth, *pairs)};
}

void add_ground_truth(Session& session, const std::optional<fs::path>& given) {
  const fs::path& source = session.description.source;
  const int camera = session.description.camera;
  const auto file = given ? given : find_ground_truth(source, camera);
  if (!file) {
    if (const auto other = find_ground_truth(source, 0)) {
      session.notes.push_back(fmt::format(
          "{} is the path of camera 0, so camera {} is not compared with it (--ground-truth is)",
          other->string(), camera));
    }
    return;
  }
  auto truth = compare_with_ground_truth(session.trajectory, *file);
  if (truth) {
    session.truth = *std::move(truth);
  } else {
    session.notes.push_back(
        fmt::format("no comparison with {}: {}", file->string(), truth.error().message));
  }
}

}  // namespace sparsight
