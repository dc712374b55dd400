#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "hal/result.h"
#include "slam/loop/loop_closer.h"
#include "tools/map/map_folder.h"
#include "tools/map/paged_keyframes.h"

namespace sparsight {

struct SessionMapOptions {
  std::optional<std::filesystem::path> earlier;  // the map to go on in
  std::optional<std::filesystem::path> save_to;  // may be the same
  bool any() const { return earlier || save_to; }
};

// The maps of a session: the one it goes on in, and the one it leaves. Thread-bound.
class SessionMap {
 public:
  // Puts an earlier map's keyframes into the store, and a file for the new ones if they are to be
  // saved. An error says what to do: no map there, damaged, of another camera, or in the way.
  static Result<SessionMap> open(const SessionMapOptions& options, const LoopConfig& config,
                                 const CameraIntrinsics& camera, const Vocabulary& vocabulary,
                                 PagedKeyframes& keyframes);

  // The earlier map, if there is one, before the first keyframe.
  void resume(LoopCloser& loops);
  // What the session ended with, and all before it. Nothing to do if it is not to be saved.
  Result<void> save(const LoopCloser& loops, const Vocabulary& vocabulary,
                    const std::string& source, PagedKeyframes& keyframes);
  // For people: whether the session found itself in the earlier map, and what was saved.
  std::vector<std::string> remarks(const LoopCloser& loops) const;

 private:
  Result<void> take_earlier(const LoopConfig& config, const CameraIntrinsics& camera,
                            const Vocabulary& vocabulary, PagedKeyframes& keyframes);
  Result<void> take_in(MapIndex& index);

  SessionMapOptions options_;
  std::optional<MapIndex> earlier_;  // its known places are moved out by resume()
  std::optional<MapWriter> writer_;
};

}  // namespace sparsight
