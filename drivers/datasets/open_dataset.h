#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "hal/frame_source.h"
#include "hal/result.h"

namespace sparsight {

struct DatasetOptions {
  std::optional<int> rays;    // keep that many of each scan's rings, evenly; all if not given
  std::optional<int> camera;  // the lowest one that is there if not given
};

// Opens a data set folder, in whichever of the known layouts it is: a KITTI odometry sequence or a
// KITTI raw drive. Frames are read ahead on a thread of their own.
Result<std::unique_ptr<FrameSource>> open_dataset(const std::filesystem::path& folder,
                                                  const DatasetOptions& options);

}  // namespace sparsight
