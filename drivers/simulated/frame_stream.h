#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/simulated/event_stream.h"
#include "drivers/simulated/frame_renderer.h"
#include "drivers/simulated/imager.h"
#include "drivers/simulated/made_ahead.h"
#include "drivers/simulated/rig_clocks.h"
#include "drivers/simulated/walk.h"

namespace sparsight::simulated {

struct FrameContext {
  const SimulationOptions& options;
  const RigCalibration& calibration;
  const World& world;
  const Walk& walk;
  const CameraClock& clock;
  const FaultPlan& faults;
};

// The camera: frames rendered at the middle of their exposure.
class FrameStream : public EventStream {
 public:
  explicit FrameStream(const FrameContext& context);

  std::optional<HostTime> peek() const override;
  RigEvent take() override;

 private:
  struct Due {
    std::uint64_t number;
    std::uint32_t sequence;
    std::uint32_t epoch;
  };
  void plan();
  std::vector<std::uint8_t> look(std::uint64_t number) const;

  FrameContext context_;
  FrameRenderer renderer_;
  Imager imager_;
  std::vector<Due> due_;
  std::size_t next_ = 0;
  MadeAhead<std::vector<std::uint8_t>> images_;
};

}  // namespace sparsight::simulated
