#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "realtime/pipeline/frame_record.h"

namespace sparsight {

// What a person is told when tracking is lost and when it goes on. Thread-bound.
class TrackingNews {
 public:
  // Of the next frame, if it is news.
  std::optional<std::string> of(const FrameRecord& record);

 private:
  bool lost_ = false;
  std::uint32_t submap_ = 0;
};

}  // namespace sparsight
