#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal/calibration.h"
#include "hal/image.h"
#include "hal/result.h"
#include "hal/sweep.h"
#include "hal/time.h"

namespace sparsight {

// An image with the LiDAR returns around its exposure. What could not be read is left empty and
// named in `faults`: the frame keeps its place and its time.
struct SynchronizedFrame {
  std::uint64_t sequence = 0;  // position in the source, without gaps
  HostTime exposure;           // middle of the exposure
  GreyImage grey;              // empty: no image
  std::optional<ColorImage> color;
  Sweep sweep;  // no returns: no depth
  std::vector<Error> faults;
};

// Where frames come from: a recording, a data set, the live rig. Thread-bound.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual const RigCalibration& calibration() const = 0;
  // How many frames next() will yield, where that is known; of a rig's frames fewer come, as the
  // first have nobody to vouch for their time.
  virtual std::optional<std::size_t> frame_count() const = 0;
  // Frames in the order of their exposure; nothing after the last.
  virtual std::optional<SynchronizedFrame> next() = 0;
};

}  // namespace sparsight
