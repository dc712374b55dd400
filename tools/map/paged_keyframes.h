#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/map/keyframe_store.h"
#include "tools/map/keyframe_file.h"

namespace sparsight {

// The bulk of keyframes on the disk: those of earlier sessions where they are, new ones in a file
// of this session. In memory remain 24 bytes of each. Thread-bound.
class PagedKeyframes : public KeyframeStore {
 public:
  struct Place {
    std::uint32_t file = 0;               // as files() has them
    std::optional<KeyframePlace> record;  // none: it could not be kept
  };

  // Takes over files whose records stand at `places`; before the first put().
  void take_over(std::vector<KeyframeFile> files, std::vector<Place> places);
  // Where new ones go; without, none is kept.
  void write_to(KeyframeFile file);
  bool writes() const { return written_.has_value(); }

  std::size_t put(const KeyframeBulk& bulk) override;
  std::optional<KeyframeBulk> get(std::size_t number) override;

  std::vector<KeyframeFile>& files() { return files_; }
  const std::vector<Place>& places() const { return places_; }
  std::size_t not_kept() const { return not_kept_; }       // of those put in
  std::size_t damaged() const { return damaged_; }         // reads that failed
  const std::string& message() const { return message_; }  // of the last that went wrong

 private:
  std::vector<KeyframeFile> files_;
  std::optional<std::uint32_t> written_;  // of files_
  std::vector<Place> places_;
  std::size_t not_kept_ = 0;
  std::size_t damaged_ = 0;
  std::string message_;
};

}  // namespace sparsight
