#include "tools/map/session_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/camera_model.h"
#include "slam/loop/orb_features.h"
#include "slam/loop/place_image.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

bool same_folder(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) && !error;
}

// Self-calibration moves the focal length by a few thousandths.
bool same_camera(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  constexpr double kShare = 0.02;
  return a.width == b.width && a.height == b.height && std::abs(a.fx - b.fx) < kShare * b.fx &&
         std::abs(a.fy - b.fy) < kShare * b.fy && std::abs(a.cx - b.cx) < kShare * b.width &&
         std::abs(a.cy - b.cy) < kShare * b.height;
}

Result<void> check_camera(const fs::path& folder, const KnownPlaces& known,
                          const CameraIntrinsics& camera) {
  for (const KnownKeyframe& keyframe : known.keyframes) {
    const CameraIntrinsics& its = keyframe.camera;
    if (same_camera(its, camera)) continue;
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("{}: was made with another camera: keyframes of {}x{}, focal length {:.1f} "
                    "pixels, and here {}x{}, {:.1f}; map with the same camera and image_level",
                    (folder / kMapIndexFile).string(), its.width, its.height, its.fx, camera.width,
                    camera.height, camera.fx));
  }
  return {};
}

// Words of another vocabulary, or of none that is: found again in the images.
void find_words_again(KnownPlaces& known, const LoopConfig& config, const Vocabulary& vocabulary,
                      PagedKeyframes& keyframes) {
  for (std::size_t i = 0; i < known.keyframes.size(); ++i) {
    const auto bulk = keyframes.get(i);
    known.keyframes[i].bag =
        bulk ? vocabulary.bag_of(
                   orb_features(bulk->image, {.features = config.features}).descriptors)
             : BagOfWords{};
  }
}

bool words_are_of(const KnownPlaces& known, const Vocabulary& vocabulary) {
  return std::ranges::all_of(known.keyframes, [&](const KnownKeyframe& keyframe) {
    return keyframe.bag.empty() || keyframe.bag.back().word < vocabulary.words();
  });
}

}  // namespace

Result<SessionMap> SessionMap::open(const SessionMapOptions& options, const LoopConfig& config,
                                    const CameraIntrinsics& camera, const Vocabulary& vocabulary,
                                    PagedKeyframes& keyframes) {
  SessionMap map;
  map.options_ = options;
  if (options.any() && !config.enabled) {
    return fail(ErrorCode::kOutOfRange,
                "--map and --save-map need loops: leave out --no-loops, or set [loop] enabled");
  }
  if (options.save_to) {
    const bool continues = options.earlier && same_folder(*options.earlier, *options.save_to);
    auto writer = MapWriter::claim(*options.save_to, continues);
    if (!writer) return tl::unexpected(writer.error());
    map.writer_ = std::move(*writer);
  }
  if (options.earlier) {
    if (auto taken = map.take_earlier(config, camera, vocabulary, keyframes); !taken) {
      return tl::unexpected(taken.error());
    }
  }
  if (map.writer_) {
    auto file = map.writer_->new_keyframe_file();
    if (!file) return tl::unexpected(file.error());
    keyframes.write_to(std::move(*file));
  }
  return map;
}

Result<void> SessionMap::take_earlier(const LoopConfig& config, const CameraIntrinsics& camera,
                                      const Vocabulary& vocabulary, PagedKeyframes& keyframes) {
  auto opened = open_map(*options_.earlier);
  if (!opened) return tl::unexpected(opened.error());
  const int level = place_image_level(config.image_level, camera.width);
  const CameraIntrinsics halved = CameraModel(camera).at_level(level).intrinsics();
  if (auto checked = check_camera(*options_.earlier, opened->index.known, halved); !checked) {
    return checked;
  }
  keyframes.take_over(std::move(opened->files), opened->index.places);
  earlier_ = std::move(opened->index);
  if (earlier_->vocabulary != fingerprint_of(vocabulary) ||
      !words_are_of(earlier_->known, vocabulary)) {
    find_words_again(earlier_->known, config, vocabulary, keyframes);
  }
  return {};
}

void SessionMap::resume(LoopCloser& loops) {
  if (earlier_) loops.resume(std::exchange(earlier_->known, {}));
}

// The earlier map's files, if they are not where the new map is to be.
Result<void> SessionMap::take_in(MapIndex& index) {
  if (!earlier_) return {};
  index.sessions = earlier_->sessions;
  index.files = earlier_->files;
  if (same_folder(*options_.earlier, writer_->folder())) return {};
  for (MapIndex::File& file : index.files) {
    auto adopted = writer_->adopt(*options_.earlier / file.name, file.bytes);
    if (!adopted) return tl::unexpected(adopted.error());
    file = *adopted;
  }
  return {};
}

Result<void> SessionMap::save(const LoopCloser& loops, const Vocabulary& vocabulary,
                              const std::string& source, PagedKeyframes& keyframes) {
  if (!writer_) return {};
  MapIndex index{.vocabulary = fingerprint_of(vocabulary)};
  if (auto taken = take_in(index); !taken) return taken;
  KeyframeFile& own = keyframes.files().back();
  if (auto synced = own.sync(); !synced) return synced;
  index.sessions.push_back(source);
  index.files.push_back({own.path().filename(), own.bytes()});
  index.places = keyframes.places();
  index.known = loops.known();
  return writer_->commit(index);
}

std::vector<std::string> SessionMap::remarks(const LoopCloser& loops) const {
  std::vector<std::string> remarks;
  const std::vector<Submap> submaps = loops.submaps();
  const auto joined = std::ranges::count_if(submaps, &Submap::in_earlier_map);
  if (options_.earlier && joined > 0) {
    remarks.push_back(
        fmt::format("goes on in the map {}: the poses of {} of its {} sub-maps are in "
                    "that map's frame",
                    options_.earlier->string(), joined, submaps.size()));
  } else if (options_.earlier) {
    remarks.push_back(
        fmt::format("no place of the map {} was recognised: the poses are in a frame "
                    "of their own",
                    options_.earlier->string()));
  }
  if (writer_) remarks.push_back("the map is saved in " + writer_->folder().string());
  return remarks;
}

}  // namespace sparsight
