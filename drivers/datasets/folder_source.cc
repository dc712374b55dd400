#include "drivers/datasets/folder_source.h"

#include <fmt/format.h>

#include <utility>

#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/image_file.h"
#include "drivers/datasets/rings.h"
#include "drivers/datasets/velodyne_scan.h"

namespace sparsight {

FolderSource::FolderSource(FolderIndex index, std::optional<int> rings)
    : index_(std::move(index)), rings_(rings) {}

std::optional<SynchronizedFrame> FolderSource::next() {
  if (next_ == index_.frames.size()) return std::nullopt;
  const FolderFrame& from = index_.frames[next_];
  SynchronizedFrame frame;
  frame.sequence = next_++;
  frame.exposure = from.exposure;
  frame.faults = from.faults;
  read_image(from, frame);
  read_scan(from, frame);
  return frame;
}

void FolderSource::read_image(const FolderFrame& from, SynchronizedFrame& frame) const {
  auto image = read_file_bytes(from.image).and_then([&](const std::string& bytes) {
    return decode_image(bytes, from.image.string());
  });
  if (!image) {
    frame.faults.push_back(std::move(image.error()));
    return;
  }
  const CameraIntrinsics& camera = index_.calibration.camera;
  if (image->grey.width != camera.width || image->grey.height != camera.height) {
    frame.faults.push_back(
        {ErrorCode::kWrongSize,
         fmt::format("{}: image of {} x {} pixels among images of {} x {}", from.image.string(),
                     image->grey.width, image->grey.height, camera.width, camera.height)});
    return;
  }
  frame.grey = std::move(image->grey);
  frame.color = std::move(image->color);
}

void FolderSource::read_scan(const FolderFrame& from, SynchronizedFrame& frame) const {
  frame.sweep.motion_compensated = index_.motion_compensated;
  if (!from.sweep && !index_.motion_compensated) return;  // the index says why
  auto scan = read_file_bytes(from.scan).and_then([&](const std::string& bytes) {
    const bool text = from.scan.extension() == ".txt";
    return (text ? parse_velodyne_text : parse_velodyne_scan)(bytes, from.scan.string());
  });
  if (!scan) {
    frame.faults.push_back(std::move(scan.error()));
    return;
  }
  if (scan->refused > 0) {
    frame.faults.push_back(
        {ErrorCode::kOutOfRange,
         fmt::format(
             "{}: {} of {} points are not finite numbers of a LiDAR's range and were left out",
             from.scan.string(), scan->refused, scan->refused + scan->returns.size())});
  }
  if (scan->returns.empty()) {
    frame.faults.push_back(
        {ErrorCode::kWrongSize, fmt::format("{}: a scan without returns", from.scan.string())});
  }
  std::vector<LidarReturn> returns = std::move(scan->returns);
  const std::size_t ring_count = assign_rings(returns);
  if (rings_) keep_rings(returns, ring_count, static_cast<std::size_t>(*rings_));
  if (from.sweep) stamp_returns(returns, *from.sweep, from.exposure);
  frame.sweep.returns = std::move(returns);
}

}  // namespace sparsight
