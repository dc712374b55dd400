#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/result.h"
#include "tools/map/keyframe_file.h"
#include "tools/map/map_index.h"

namespace sparsight {

// A map in a folder: files of keyframes that are written once and never changed, and map.index,
// which says what of them is the map. A session writes a new file of keyframes, and when all of
// that is on the disk a new index takes the place of the old one in a single step (rename):
// whatever happens before, the old map is as it was, whatever happens after, the new one is. What
// no index speaks of is left from a session that was cut off; the next one that saves removes it.
inline constexpr const char* kMapIndexFile = "map.index";

bool holds_map(const std::filesystem::path& folder);

struct OpenedMap {
  MapIndex index;
  std::vector<KeyframeFile> files;  // as in the index
};
Result<OpenedMap> open_map(const std::filesystem::path& folder);

// Where a session saves its map. While it is there no other session may save to the folder.
// Thread-bound.
class MapWriter {
 public:
  // Makes the folder if it is not there. `continues`: the map it holds, if any, is to be gone on
  // with; otherwise a folder with a map is refused.
  static Result<MapWriter> claim(const std::filesystem::path& folder, bool continues);
  MapWriter(MapWriter&&) noexcept;
  MapWriter& operator=(MapWriter&&) noexcept;
  ~MapWriter();

  // A file for this session's keyframes, of a new name.
  Result<KeyframeFile> new_keyframe_file();
  // Brings in a file of a map elsewhere: as a second name of the same bytes if the disk can do
  // that.
  Result<MapIndex::File> adopt(const std::filesystem::path& file, std::uint64_t bytes);
  // The step after which the map is the new one; then removes what it does not need.
  Result<void> commit(const MapIndex& index);

  const std::filesystem::path& folder() const { return folder_; }

 private:
  MapWriter(std::filesystem::path folder, int lock);
  std::filesystem::path unused_name() const;
  void remove_unused(const MapIndex& index) const;

  std::filesystem::path folder_;
  int lock_ = -1;  // of the folder; the system gives it back however the program ends
};

}  // namespace sparsight
