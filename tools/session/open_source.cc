#include "tools/session/open_source.h"

#include <utility>

#include "drivers/datasets/capture_folder.h"
#include "drivers/datasets/open_dataset.h"
#include "tools/session/captured_frames.h"
#include "tools/session/recorded_frames.h"

namespace sparsight {

bool is_recording(const std::filesystem::path& source) { return source.extension() == ".mcap"; }

Result<OpenedSource> open_source(const std::filesystem::path& source,
                                 const SourceOptions& options) {
  if (is_recording(source)) return open_recording(source, options);
  if (is_capture_folder(source)) return open_capture(source, options);
  auto frames = open_dataset(source, {.rays = options.rays, .camera = options.camera});
  if (!frames) return tl::unexpected(frames.error());
  return OpenedSource{.frames = std::move(*frames), .full_intensity = 1.0F};  // KITTI's scale
}

}  // namespace sparsight
