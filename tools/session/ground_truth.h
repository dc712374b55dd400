#pragma once

#include <filesystem>
#include <optional>

#include "tools/session/session.h"

namespace sparsight {

// The ground truth that goes with a data set folder as it is distributed (KITTI odometry:
// ../../poses/NN.txt) or stands in it (poses_camera_0.txt). Both are of camera 0: nothing for the
// others.
std::optional<std::filesystem::path> find_ground_truth(const std::filesystem::path& source,
                                                       int camera);

// Compares the session with `given`, else with the data set's own ground truth, if there is one.
// What could not be compared is noted.
void add_ground_truth(Session& session, const std::optional<std::filesystem::path>& given);

// Compares by time if the file has times, else line by line. Segments are 100 ... 800 m long, on a
// true path up to 200 m 10 ... 50 m.
Result<GroundTruth> compare_with_ground_truth(const std::vector<TrajectoryPose>& trajectory,
                                              const std::filesystem::path& file);

}  // namespace sparsight
