#include "tools/evaluation/part_error.h"

#include <cmath>
#include <iterator>
#include <vector>

#include "tools/evaluation/association.h"
#include "tools/evaluation/rigid_alignment.h"

namespace sparsight {
namespace {

constexpr std::size_t kFewestToAlign = 3;

struct Part {
  std::vector<Eigen::Vector3d> truth;
  std::vector<Eigen::Vector3d> estimate;
};

PartsOfTime parts_of_time(const SessionLoops& session, std::uint64_t SessionLoops::Submap::*name) {
  PartsOfTime parts;
  for (const SessionLoops::Submap& submap : session.submaps) {
    const auto begin = session.exposures.find(submap.first_frame);
    if (begin != session.exposures.end()) parts[begin->second] = submap.*name;
  }
  return parts;
}

std::uint64_t part_at(HostTime time, const PartsOfTime& parts) {
  const auto after = parts.upper_bound(time);
  return after == parts.begin() ? after->second : std::prev(after)->second;
}

}  // namespace

PartsOfTime submaps_of_time(const SessionLoops& session) {
  return parts_of_time(session, &SessionLoops::Submap::first_frame);
}

PartsOfTime joined_parts_of_time(const SessionLoops& session) {
  return parts_of_time(session, &SessionLoops::Submap::part);
}

std::optional<double> part_error_m(const Trajectory& estimate, const Trajectory& truth,
                                   const PartsOfTime& times) {
  if (times.empty()) return std::nullopt;
  std::map<std::uint64_t, Part> parts;
  for (const IndexPair& pair : associate_by_time(estimate.times, truth.times, kSimultaneous)) {
    Part& part = parts[part_at(estimate.times[pair.estimate], times)];
    part.truth.emplace_back(truth.poses[pair.truth].translation());
    part.estimate.emplace_back(estimate.poses[pair.estimate].translation());
  }
  double squares = 0.0;
  std::size_t count = 0;
  for (const auto& [name, part] : parts) {
    if (part.truth.size() < kFewestToAlign) continue;
    const Eigen::Isometry3d T_truth_estimate = align_rigidly(part.truth, part.estimate);
    for (std::size_t i = 0; i < part.truth.size(); ++i) {
      squares += (T_truth_estimate * part.estimate[i] - part.truth[i]).squaredNorm();
    }
    count += part.truth.size();
  }
  if (count == 0) return std::nullopt;
  return std::sqrt(squares / static_cast<double>(count));
}

}  // namespace sparsight
