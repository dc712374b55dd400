#include "tools/session/live_session.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "drivers/recording/recorder.h"
#include "realtime/executor/service_notifier.h"
#include "realtime/executor/thread_setup.h"
#include "realtime/pipeline/live_pipeline.h"
#include "slam/loop/loop_closer.h"
#include "tools/configuration/rig_file.h"
#include "tools/loop/vocabulary_file.h"
#include "tools/session/frame_figures.h"
#include "tools/session/interrupt.h"
#include "tools/session/live_text.h"
#include "tools/session/process_load.h"
#include "tools/session/session_recorder.h"
#include "tools/session/session_summary.h"
#include "tools/session/submap_news.h"
#include "tools/session/tracking_news.h"

namespace sparsight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookPeriod{100};
constexpr std::chrono::seconds kShowPeriod{1};
constexpr std::size_t kHeapTouched = std::size_t{64} << 20;

StageTimes times_of(const LatencySnapshot& latency) {
  return {.median_ms = to_milliseconds(latency.percentile(0.5)),
          .p99_ms = to_milliseconds(latency.percentile(0.99)),
          .max_ms = to_milliseconds(latency.max)};
}

Result<std::unique_ptr<Recorder>> start_recorder(const LiveRig& rig, const LiveOptions& options) {
  if (!options.recording) return nullptr;
  RecordingContent content;
  content.attachments.push_back(
      {kRigConfigurationAttachment, "application/toml", describe(rig.config)});
  if (rig.config.calibration.camera.width > 0) content.calibration = rig.config.calibration;
  content.utc_offset = current_utc_offset();
  content.session["source"] = rig.source.string();
  content.session["sparsight"] = SPARSIGHT_VERSION;
  return Recorder::create(options.folder / "recording.mcap", content);
}

// What one live run consists of, and the loop that watches over it.
class LiveRun {
 public:
  LiveRun(LiveRig rig, const LiveOptions& options, std::unique_ptr<Recorder> recorder)
      : options_(options),
        recorder_(std::move(recorder)),
        session_(options.folder, description(rig, options),
                 options.odometry ? options.map : std::vector<CloudFormat>{},
                 AtomicFile::Appears::kAtOnce),
        given_(rig.config.calibration.camera),
        loops_(closer(options, session_.keyframes())),
        pipeline_(std::move(rig.devices), rig.config.calibration, options.config,
                  sync_config(rig.config), outputs(), live_config(rig, options)) {}

  Result<void> begin() {
    auto map = SessionMap::open(options_.maps, options_.config.loop, given_, *built_in_vocabulary(),
                                *session_.keyframes());
    if (!map) return tl::unexpected(map.error());
    map_ = std::move(*map);
    if (loops_) map_.resume(*loops_);
    return session_.begin();
  }
  void note(const std::string& remark) {
    say("note: " + remark);
    session_.session().notes.push_back(remark);
  }

  void run() {
    const InterruptRequest interrupt;
    const ServiceNotifier service = ServiceNotifier::from_environment();
    pipeline_.start();
    service.ready();
    const auto start = Clock::now();
    for (Clock::time_point next = start; !interrupt.pending() && !pipeline_.ended();) {
      if (options_.duration && Clock::now() - start >= *options_.duration) break;
      look(service);
      next += kLookPeriod;
      std::this_thread::sleep_until(next);
    }
    service.stopping();
    end(Clock::now() - start);
  }

  Result<LiveResult> result() {
    if (auto written = session_.write(); !written) return tl::unexpected(written.error());
    auto failure = options_.odometry ? failure_of(session_.session()) : std::nullopt;
    if (!saved_) failure = saved_.error();
    return LiveResult{std::move(session_.session()), std::move(failure)};
  }

 private:
  static SessionDescription description(const LiveRig& rig, const LiveOptions& options) {
    return {.source = rig.source,
            .profile_name = options.profile_name,
            .config = options.config,
            .calibration = rig.config.calibration};
  }
  static LiveConfig live_config(const LiveRig& rig, const LiveOptions& options) {
    return {.rate_hz = rig.config.camera.rate_hz,
            .realtime = options.realtime,
            .odometry = options.odometry};
  }

  static std::unique_ptr<LoopCloser> closer(const LiveOptions& options,
                                            std::shared_ptr<KeyframeStore> keyframes) {
    if (!options.odometry || !options.config.loop.enabled) return nullptr;
    return std::make_unique<LoopCloser>(options.config, built_in_vocabulary(),
                                        std::move(keyframes));
  }

  LiveOutputs outputs() {
    LiveOutputs outputs;
    if (recorder_) {
      outputs.on_event = [this](RigEvent&& event) { recorder_->record(std::move(event)); };
      outputs.on_preview = [this](const LivePreview& preview) {
        const LivePose& pose = preview.pose;
        if (pose.status == FrameOutcome::Status::kLost) return;
        RecordedPose recorded{pose.exposure, pose.T_world_camera};
        if (preview.placed) recorded.T_map_world = preview.T_map_world;
        recorder_->record(recorded);
      };
    }
    // A fault is told when its kind first comes, and counted from then on.
    outputs.on_frame = [this](FrameRecord&& record) {
      for (const Error& fault : session_.add(record)) {
        say(fmt::format("frame {}: {} (more of this kind are only counted)", record.sequence,
                        fault.message));
      }
      if (const auto news = tracking_news_.of(record)) say(*news);
    };
    outputs.on_keyframe = [this](RetiredKeyframe&& keyframe, const KeyframeEffort& effort) {
      return take(keyframe, effort);
    };
    return outputs;
  }

  // On the background thread.
  MapPlace take(const RetiredKeyframe& keyframe, const KeyframeEffort& effort) {
    session_.add(keyframe);
    if (keyframe.begins_submap) ++place_.submap;
    if (!loops_) {
      place_.placed = place_.submap == 0;
      return place_;
    }
    loops_->add(keyframe, given_, effort.search_loops);
    place_.T_map_world = loops_->T_map_odometry();
    place_.placed = loops_->placed();
    for (const std::string& news : submap_news_.of(*loops_)) say(news);
    return place_;
  }

  void say(const std::string& line) const {
    if (!options_.quiet) fmt::print(stderr, "{}\n", line);
  }

  void look(const ServiceNotifier& service) {
    status_ = pipeline_.look();
    for (const std::string& remark : pipeline_.remarks()) note(remark);
    tell_devices();
    tell_recording();
    const auto now = Clock::now();
    if (const auto interval = service.watchdog_interval(); interval && now >= next_feed_) {
      next_feed_ = now + *interval;
      if (pipeline_.standing_still().empty()) service.feed_watchdog();
    }
    if (now < next_show_) return;
    next_show_ += kShowPeriod;
    show(service);
  }

  // What becomes of a sensor is said when it changes.
  void tell_devices() {
    const std::pair<const char*, const DeviceStatus*> devices[] = {
        {"camera", &status_.camera}, {"lidar", &status_.lidar}, {"trigger", &status_.trigger}};
    for (std::size_t i = 0; i < std::size(devices); ++i) {
      const auto& [name, device] = devices[i];
      if (std::exchange(told_[i], device->state) == device->state) continue;
      say(fmt::format("{} is {}{}{}", name, name_of(device->state),
                      device->message.empty() ? "" : ": ", device->message));
    }
  }

  // Once: what ended it does not go away by itself.
  void tell_recording() {
    if (!recorder_ || recording_ended_) return;
    const RecorderReport report = recorder_->report();
    recording_ended_ = report.state != RecorderState::kRecording;
    if (recording_ended_) say(report.message);
  }

  void show(const ServiceNotifier& service) {
    LiveView view{.now = status_, .before = shown_, .resident_bytes = resident_bytes()};
    if (recorder_) view.recorder = recorder_->report();
    const auto cpu = processor_time();
    const auto wall = Clock::now();
    view.cpu_share = to_seconds(cpu - shown_cpu_) / std::max(1e-3, to_seconds(wall - shown_wall_));
    shown_cpu_ = cpu;
    shown_wall_ = wall;
    shown_ = status_;
    const std::string line = live_line(view);
    service.status(line);
    if (options_.json) {
      fmt::print("{}\n", live_json(view));
      std::fflush(stdout);
    } else {
      say(line);
    }
  }

  void end(std::chrono::nanoseconds wall) {
    pipeline_.stop();
    status_ = pipeline_.look();
    Session& session = session_.session();
    if (recorder_) note_recording(recorder_->finish(), session);
    session.live = figures(wall);
    note_losses(session);
    if (options_.odometry) tell_camera_found(given_, pipeline_.camera(), session);
    session_.end(trajectories(), wall);
    if (loops_) save_map();
  }

  void save_map() {
    saved_ = map_.save(*loops_, *built_in_vocabulary(),
                       session_.session().description.source.string(), *session_.keyframes());
    if (!saved_) return;
    for (const std::string& remark : map_.remarks(*loops_)) {
      session_.session().notes.push_back(remark);
    }
  }

  ReplayTrajectories trajectories() {
    ReplayTrajectories result{.odometry = pipeline_.trajectory()};
    if (loops_) {
      loops_->finish();
      result.placed = loops_->placed_keyframes();
      result.corrected = pipeline_.trajectory(loops_->poses());
      session_.session().loops = loops_->loops();
      session_.session().loop_statistics = loops_->statistics();
      session_.session().submaps = loops_->submaps();
    }
    return result;
  }

  LiveFigures figures(std::chrono::nanoseconds wall) const {
    LiveFigures live{.exposure_to_pose = times_of(status_.exposure_to_pose),
                     .arrival_to_pose = times_of(status_.arrival_to_pose),
                     .wake_up = times_of(status_.wake_up),
                     .deadlines_missed = status_.deadlines_missed,
                     .frames_dropped = status_.frames_dropped,
                     .events_unrecorded = status_.events_dropped()};
    live.work_left_out = status_.previews_left_out + status_.searches_left_out +
                         status_.windows_shortened + status_.frames_coarse +
                         status_.pose_searches_cut;
    if (status_.first_pose) live.first_pose_s = to_seconds(*status_.first_pose);
    live.cpu_share = to_seconds(processor_time()) / std::max(1e-3, to_seconds(wall));
    live.resident_bytes = resident_bytes();
    return live;
  }

  void note_recording(const RecorderReport& report, Session& session) const {
    session.notes.push_back(fmt::format(
        "recorded {:.1f} MB; the devices delivered {} frames, {} LiDAR packets, {} edges",
        1e-6 * static_cast<double>(report.bytes_written), status_.camera.events,
        status_.lidar.events, status_.trigger.events));
    if (report.events_refused > 0) {
      session.notes.push_back(
          fmt::format("{} of these came after the recording had ended, and are not in it",
                      report.events_refused));
    }
    if (!report.message.empty()) session.notes.push_back(report.message);
    if (report.lost_anything_raw()) {
      session.notes.push_back(fmt::format(
          "the disk was too slow: {} frames and {} packets or edges are not in the recording",
          report.frames_dropped, report.packets_dropped));
    }
  }

  void note_losses(Session& session) const {
    if (status_.frames_dropped > 0) {
      session.notes.push_back(
          fmt::format("{} frames came too fast to be tracked", status_.frames_dropped));
    }
    if (status_.records_dropped > 0) {
      session.notes.push_back(fmt::format("{} frames are missing in frames.csv and the trajectory",
                                          status_.records_dropped));
    }
    if (status_.events_dropped() > 0) {
      session.notes.push_back(
          fmt::format("{} raw events came too fast to be recorded", status_.events_dropped()));
    }
  }

  const LiveOptions& options_;
  std::unique_ptr<Recorder> recorder_;
  SessionRecorder session_;
  CameraIntrinsics given_;
  TrackingNews tracking_news_;         // the journal thread's
  std::unique_ptr<LoopCloser> loops_;  // the background thread's, until the pipeline has stopped
  SubmapNews submap_news_;             // likewise
  MapPlace place_;                     // likewise
  SessionMap map_;
  Result<void> saved_;
  LivePipeline pipeline_;  // after what its outputs use
  LiveStatus status_;
  LiveStatus shown_;
  std::chrono::nanoseconds shown_cpu_ = processor_time();
  Clock::time_point shown_wall_ = Clock::now();
  Clock::time_point next_show_ = Clock::now() + kShowPeriod;
  Clock::time_point next_feed_ = Clock::now();
  bool recording_ended_ = false;
  DeviceState told_[3] = {DeviceState::kStreaming, DeviceState::kStreaming,
                          DeviceState::kStreaming};
};

}  // namespace

Result<LiveResult> run_live(LiveRig rig, const LiveOptions& options) {
  if (options.odometry && rig.config.calibration.camera.width == 0) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: has no [calibration.camera]; calibrate the rig, or only record",
                            rig.source.string()));
  }
  const auto remark = options.realtime ? set_up_memory(kHeapTouched) : std::nullopt;
  auto recorder = start_recorder(rig, options);
  if (!recorder) return tl::unexpected(recorder.error());
  const auto run = std::make_unique<LiveRun>(std::move(rig), options, std::move(*recorder));
  if (auto begun = run->begin(); !begun) return tl::unexpected(begun.error());
  if (remark) run->note(*remark);
  run->run();
  return run->result();
}

}  // namespace sparsight
