#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "hal/camera.h"
#include "hal/stamp.h"
#include "hal/trigger_line.h"
#include "realtime/sync/exposure_pairing.h"
#include "realtime/sync/pulse_train.h"

namespace sparsight {

struct EdgeMatcherConfig {
  bool exposure_active = true;  // as TriggerConfig has it
  std::chrono::nanoseconds trigger_delay{0};
  // The least time between the end of an exposure and CameraFrame::driver_time. At the start it
  // decides which of the edges, a period apart, is a frame's: the one that leaves between this and
  // this plus a period. Above zero for a camera that takes longer than a period to deliver;
  // negative for a driver that stamps the start of the exposure.
  std::chrono::nanoseconds min_frame_delay{0};
  std::size_t frames_to_accept = 8;             // in a row, consistent, before an association holds
  double max_spread = 0.3;                      // of their delays, as share of the period
  std::chrono::nanoseconds edge_sigma{20'000};  // of one edge's stamp: interrupt latency
};

// A frame and when it was exposed. Quality kArrival: nobody knows; `mapped` is when it came.
struct StampedFrame {
  std::shared_ptr<const CameraFrame> frame;
  Stamp stamp;

  bool synchronized() const { return stamp.quality != StampQuality::kArrival; }
};

struct CameraSyncState {
  bool locked = false;              // frames are associated with edges
  std::uint32_t associations = 0;   // made so far; each is a Stamp epoch
  std::uint64_t edges_matched = 0;  // exposures whose edges stamped a frame
  std::uint64_t edges_lost = 0;     // exposures that left no edge, or only one
  std::uint64_t edges_doubled = 0;  // second and stray ones
  std::uint64_t frames = 0;
  std::uint64_t frames_lost = 0;  // gaps in the sequence
  std::uint64_t frames_late = 0;
  std::uint64_t frames_estimated = 0;
  std::uint64_t frames_unsynchronized = 0;
  std::chrono::nanoseconds period{0};
  std::chrono::nanoseconds edge_jitter{0};   // one sigma around the period model
  std::chrono::nanoseconds delay{0};         // least, from end of exposure to driver_time
  std::chrono::nanoseconds delay_spread{0};  // mean above the least
};

// Which exposure a frame shows. Association: frame number s belongs to pulse s + k of the train of
// exposures; k is a hypothesis until a number of frames in a row have consistent delays from the
// end of their exposure, and is verified again on each frame. A frame may be late but never early:
// one whose delay does not fit is held back until the frames after it tell whether it was late
// (they fit again) or the count has slipped (they stray alike, and k is found anew). Bounded
// memory; thread-bound.
class EdgeMatcher {
 public:
  explicit EdgeMatcher(const EdgeMatcherConfig& config);

  void add(const Edge& edge);  // of EdgeLine::kExposure
  // Appends the frames whose time is now decided; the synchronised ones in the order of exposure.
  void add(std::shared_ptr<const CameraFrame> frame, std::vector<StampedFrame>& out);
  // No more frames come, or none for long: those held back are undecidable.
  void finish(std::vector<StampedFrame>& out);
  CameraSyncState state() const;

 private:
  using Frame = std::shared_ptr<const CameraFrame>;

  enum class Fit : std::uint8_t { kEarly, kGood, kLate };

  bool follows(const CameraFrame& frame, std::vector<StampedFrame>& out);
  void hold(Frame frame, std::vector<StampedFrame>& out);
  void associate(std::vector<StampedFrame>& out);
  std::optional<std::int64_t> common_offset() const;
  std::int64_t whole_periods(std::chrono::nanoseconds delay) const;
  Fit fit(std::chrono::nanoseconds delay) const;
  std::chrono::nanoseconds delay_of(const CameraFrame& frame, std::int64_t offset) const;
  std::optional<std::chrono::nanoseconds> least_delay() const;
  void learn_delay(std::chrono::nanoseconds delay);

  void emit(const Frame& frame, std::vector<StampedFrame>& out);
  void emit_unsynchronized(const Frame& frame, std::vector<StampedFrame>& out);
  std::optional<Stamp> stamp_of(const CameraFrame& frame) const;
  std::chrono::nanoseconds length_of(const CameraFrame& frame, std::int64_t index) const;
  std::chrono::nanoseconds delay_of_trigger() const;
  bool exposure_fits(const CameraFrame& frame) const;

  EdgeMatcherConfig config_;
  ExposurePairing pairing_;
  PulseTrain train_;
  std::uint32_t generation_ = 0;        // of the train that offset_ refers to
  std::optional<std::int64_t> offset_;  // pulse index minus frame sequence
  std::deque<Frame> held_;
  std::optional<std::uint32_t> last_sequence_;
  std::uint32_t camera_epoch_ = 0;
  std::optional<HostTime> last_mapped_;
  // Least delay lately: of the block of frames before, and of this one.
  std::optional<std::chrono::nanoseconds> least_before_;
  std::optional<std::chrono::nanoseconds> least_now_;
  int in_block_ = 0;
  double mean_excess_ns_ = 0.0;
  CameraSyncState counts_;
};

}  // namespace sparsight
