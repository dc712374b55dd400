#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/frame_source.h"
#include "hal/result.h"

namespace sparsight {

struct SourceOptions {
  std::optional<int> rays;    // of each scan's rings, kept evenly; all if not given
  std::optional<int> camera;  // of a data set; the lowest that is there if not given
};

struct OpenedSource {
  std::unique_ptr<FrameSource> frames;
  // What is to be said of it now: of a recording that was cut off, of a clock that never settled.
  // Complete once the frames have been read.
  std::function<std::vector<std::string>()> remarks = [] { return std::vector<std::string>{}; };
  float full_intensity = 255.0F;  // of the LiDAR's brightest return
};

// A recording of a rig, by its name.
bool is_recording(const std::filesystem::path& source);

// Opens whatever it is given: a recording (.mcap) with the rig's description in it, a folder with a
// capture and images, or a data set's folder.
Result<OpenedSource> open_source(const std::filesystem::path& source, const SourceOptions& options);

}  // namespace sparsight
