#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "drivers/datasets/firing_time.h"
#include "hal/frame_source.h"

namespace sparsight {

// What a layout says about a frame, before any of its files is opened.
struct FolderFrame {
  HostTime exposure;
  std::filesystem::path image;
  std::filesystem::path scan;
  std::optional<SweepTiming> sweep;  // needed unless scans are motion-compensated
  std::vector<Error> faults;         // why it is not there, for instance
};

// A data set as its layout describes it.
struct FolderIndex {
  RigCalibration calibration;
  std::vector<FolderFrame> frames;
  bool motion_compensated = false;
};

// Reads the files of an index frame by frame. What cannot be read becomes a fault of its frame.
class FolderSource : public FrameSource {
 public:
  // rings: keep that many of each scan's rings, evenly.
  FolderSource(FolderIndex index, std::optional<int> rings);

  const RigCalibration& calibration() const override { return index_.calibration; }
  std::optional<std::size_t> frame_count() const override { return index_.frames.size(); }
  std::optional<SynchronizedFrame> next() override;

 private:
  void read_image(const FolderFrame& from, SynchronizedFrame& frame) const;
  void read_scan(const FolderFrame& from, SynchronizedFrame& frame) const;

  FolderIndex index_;
  std::optional<int> rings_;
  std::size_t next_ = 0;
};

}  // namespace sparsight
