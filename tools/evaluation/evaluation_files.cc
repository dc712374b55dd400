#include "tools/evaluation/evaluation_files.h"

#include <fmt/format.h>

#include <array>
#include <system_error>

namespace sparsight {
namespace {

bool is_folder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

bool is_file(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

Result<Trajectory> read_estimate(const EvaluationFiles& files, const Trajectory& truth) {
  if (!is_folder(files.estimate)) {
    return read_trajectory(files.estimate, files.format);
  }
  const TrajectoryFormat preferred = files.format.value_or(
      truth.times.empty() ? TrajectoryFormat::kKitti : TrajectoryFormat::kTum);
  return trajectory_in_session(files.estimate, preferred)
      .and_then([](const std::filesystem::path& file) { return read_trajectory(file); });
}

}  // namespace

Result<std::filesystem::path> trajectory_in_session(const std::filesystem::path& folder,
                                                    TrajectoryFormat preferred) {
  std::array<const char*, 2> names = {"trajectory.kitti", "trajectory.tum"};
  if (preferred == TrajectoryFormat::kTum) {
    std::swap(names[0], names[1]);
  }
  for (const char* name : names) {
    if (is_file(folder / name)) {
      return folder / name;
    }
  }
  return fail(
      ErrorCode::kNotFound,
      fmt::format("{}: a folder without trajectory.kitti or trajectory.tum; give the folder "
                  "of a session, or a trajectory file",
                  folder.string()));
}

Result<TrajectoryPair> read_trajectories(const EvaluationFiles& files) {
  Result<Trajectory> truth = read_trajectory(files.truth);
  if (!truth) {
    return tl::unexpected(truth.error());
  }
  Result<Trajectory> estimate = read_estimate(files, *truth);
  if (!estimate) {
    return tl::unexpected(estimate.error());
  }
  if (files.times) {
    const auto times = read_times(*files.times);
    if (!times) {
      return tl::unexpected(times.error());
    }
    // A cropped sequence may come with the poses of the whole: those after its end have no times.
    if (truth->times.empty() && truth->poses.size() > times->size()) {
      truth->poses.resize(times->size());
    }
    for (Result<Trajectory>* trajectory : {&truth, &estimate}) {
      if ((*trajectory)->times.empty()) {
        *trajectory = with_times(std::move(**trajectory), *times, files.times->string());
      }
      if (!*trajectory) {
        return tl::unexpected(trajectory->error());
      }
    }
  }
  return TrajectoryPair{*std::move(estimate), *std::move(truth)};
}

}  // namespace sparsight
