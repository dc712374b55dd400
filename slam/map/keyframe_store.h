#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hal/image.h"
#include "slam/keyframe.h"

namespace sparsight {

// What of a keyframe is large and seldom looked at: by a loop's verification, and by the map.
struct KeyframeBulk {
  GreyImage image;                       // halved LoopConfig::image_level times
  std::vector<CloudPoint> cloud_camera;  // all of it
};

// Where the bulk of keyframes is kept: hours of walking do not fit into memory, and where they go
// is none of the estimator's business. Thread-bound.
class KeyframeStore {
 public:
  KeyframeStore() = default;
  KeyframeStore(const KeyframeStore&) = delete;
  KeyframeStore& operator=(const KeyframeStore&) = delete;
  virtual ~KeyframeStore() = default;

  // Returns the keyframe's number: they count from 0 in the order they are put in.
  virtual std::size_t put(const KeyframeBulk& bulk) = 0;
  // Nothing if it could not be kept or is damaged: such a keyframe closes no loop and is missing in
  // the map, and its pose stands.
  virtual std::optional<KeyframeBulk> get(std::size_t number) = 0;
};

// In memory: for walks of minutes.
class MemoryKeyframeStore : public KeyframeStore {
 public:
  std::size_t put(const KeyframeBulk& bulk) override {
    kept_.push_back(bulk);
    return kept_.size() - 1;
  }
  std::optional<KeyframeBulk> get(std::size_t number) override {
    return number < kept_.size() ? std::optional(kept_[number]) : std::nullopt;
  }

 private:
  std::vector<KeyframeBulk> kept_;
};

}  // namespace sparsight
