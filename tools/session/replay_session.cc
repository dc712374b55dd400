#include "tools/session/replay_session.h"

#include <fmt/format.h>

#include <memory>

#include "tools/loop/vocabulary_file.h"
#include "tools/session/ground_truth.h"
#include "tools/session/interrupt.h"
#include "tools/session/open_source.h"
#include "tools/session/progress.h"
#include "tools/session/session_folder.h"
#include "tools/session/session_recorder.h"
#include "tools/session/session_summary.h"
#include "tools/session/submap_news.h"
#include "tools/session/tracking_news.h"

namespace sparsight {
namespace {

using Clock = std::chrono::steady_clock;

// Ends where the person watching asks for it, as if the recording ended there.
class InterruptibleSource : public FrameSource {
 public:
  InterruptibleSource(FrameSource& source, const InterruptRequest& request)
      : source_(source), request_(request) {}

  const RigCalibration& calibration() const override { return source_.calibration(); }
  std::optional<std::size_t> frame_count() const override { return source_.frame_count(); }
  std::optional<SynchronizedFrame> next() override {
    return request_.pending() ? std::nullopt : source_.next();
  }

 private:
  FrameSource& source_;
  const InterruptRequest& request_;
};

// Without --camera the source takes the lowest camera; both KITTI layouts call camera 0 so.
int camera_of(const ReplayOptions& options) {
  if (options.camera) return *options.camera;
  for (int camera = 0; camera < 4; ++camera) {
    if (std::filesystem::exists(options.source / fmt::format("image_{}", camera)) ||
        std::filesystem::exists(options.source / fmt::format("image_{:02}", camera))) {
      return camera;
    }
  }
  return 0;
}

SessionDescription describe(const ReplayOptions& options, const OpenedSource& source) {
  return {.source = options.source,
          .profile_name = options.profile_name,
          .config = options.config,
          .rays = options.rays,
          .camera = camera_of(options),
          .calibration = source.frames->calibration(),
          .full_intensity = source.full_intensity};
}

std::optional<std::size_t> frames_to_come(const FrameSource& source, const ReplayOptions& options) {
  const auto count = source.frame_count();
  if (!options.max_frames) return count;
  return count ? std::min(*count, *options.max_frames) : *options.max_frames;
}

std::unique_ptr<LoopCloser> closer_of(const ReplayOptions& options, SessionMap& map,
                                      SessionRecorder& recorder) {
  if (!options.config.loop.enabled) return nullptr;
  auto loops =
      std::make_unique<LoopCloser>(options.config, built_in_vocabulary(), recorder.keyframes());
  map.resume(*loops);
  return loops;
}

void tell_loops(const LoopCloser& loops, Session& session) {
  session.loops = loops.loops();
  session.loop_statistics = loops.statistics();
  session.submaps = loops.submaps();
}

Result<void> save(SessionMap& map, const LoopCloser& loops, SessionRecorder& recorder) {
  auto saved = map.save(loops, *built_in_vocabulary(),
                        recorder.session().description.source.string(), *recorder.keyframes());
  if (!saved) return saved;
  for (std::string& remark : map.remarks(loops)) {
    recorder.session().notes.push_back(std::move(remark));
  }
  return {};
}

// Runs to the end of the source, or until it breaks off: then what has been gathered stands. An
// error if the map could not be saved.
Result<void> run(FrameSource& source, const ReplayOptions& options, SessionMap& map,
                 SessionRecorder& recorder) {
  Progress progress(stderr, Progress::style_for(stderr, options.quiet),
                    frames_to_come(source, options));
  TrackingNews tracking_news;
  const auto on_frame = [&](const FrameRecord& record) {
    for (const Error& fault : recorder.add(record)) {
      progress.say(fmt::format("frame {}: {} (more of this kind are only counted)", record.sequence,
                               fault.message));
    }
    if (const auto news = tracking_news.of(record)) progress.say(*news);
    progress.frame(record.exposure, name_of(record.outcome.status));
  };
  const std::unique_ptr<LoopCloser> loops = closer_of(options, map, recorder);
  SubmapNews submap_news;
  const auto on_keyframe = [&](RetiredKeyframe&& keyframe) {
    recorder.add(keyframe);
    if (!loops) return;
    for (const std::string& news : submap_news.of(*loops)) {
      progress.say(fmt::format("frame {}: {}", recorder.session().frames.back().sequence, news));
    }
  };

  const InterruptRequest interrupt;
  InterruptibleSource interruptible(source, interrupt);
  const auto start = Clock::now();
  ReplayTrajectories trajectories;
  bool whole = true;  // what was cut off in the middle of a step is no map
  try {
    Odometry odometry(source.calibration(), options.config);
    trajectories =
        replay_deterministic(interruptible, odometry, options.max_frames,
                             {.on_frame = on_frame, .on_keyframe = on_keyframe}, loops.get());
    if (loops) tell_loops(*loops, recorder.session());
    tell_camera_found(source.calibration().camera, odometry.camera(), recorder.session());
    if (interrupt.pending()) recorder.session().broke_off = "stopped on request";
  } catch (const std::exception& error) {
    recorder.session().broke_off = fmt::format("the replay broke off: {}", error.what());
    if (loops) trajectories.placed = loops->placed_keyframes();
    whole = false;
  }
  progress.end();
  recorder.end(std::move(trajectories), Clock::now() - start);
  return loops && whole ? save(map, *loops, recorder) : Result<void>{};
}

// A ground truth that cannot be read is told before hours are spent, not after.
Result<void> check_ground_truth(const std::optional<std::filesystem::path>& file) {
  if (!file) return {};
  return read_trajectory(*file).map([](const Trajectory&) {});
}

}  // namespace

Result<ReplayResult> replay_session(const ReplayOptions& options) {
  if (auto checked = check_ground_truth(options.ground_truth); !checked) {
    return tl::unexpected(checked.error());
  }
  auto source = open_source(options.source, {.rays = options.rays, .camera = options.camera});
  if (!source) return tl::unexpected(source.error());
  auto folder = claim_session_folder(options.output, options.source, options.rays);
  if (!folder) return tl::unexpected(folder.error());

  SessionRecorder recorder(*folder, describe(options, *source), options.map);
  auto map =
      SessionMap::open(options.maps, options.config.loop, source->frames->calibration().camera,
                       *built_in_vocabulary(), *recorder.keyframes());
  if (!map) return tl::unexpected(map.error());
  if (auto begun = recorder.begin(); !begun) return tl::unexpected(begun.error());
  const auto saved = run(*source->frames, options, *map, recorder);
  for (std::string& remark : source->remarks()) {
    recorder.session().notes.push_back(std::move(remark));
  }
  add_ground_truth(recorder.session(), options.ground_truth);
  if (auto written = recorder.write(); !written) return tl::unexpected(written.error());
  auto failure = saved ? failure_of(recorder.session()) : saved.error();
  return ReplayResult{*folder, std::move(recorder.session()), std::move(failure)};
}

}  // namespace sparsight
