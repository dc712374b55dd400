#include "drivers/recording/recording_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/recording/camera_messages.h"
#include "drivers/recording/lidar_messages.h"
#include "drivers/recording/message_schemas.h"
#include "drivers/recording/ros_header.h"

namespace sparsight {
namespace {

using mcap::Buffer;

std::uint64_t log_time(HostTime time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time.time_since_epoch().count(), 0));
}

}  // namespace

std::chrono::nanoseconds current_utc_offset() {
  return std::chrono::system_clock::now().time_since_epoch() - HostClock::now().time_since_epoch();
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& path,
                                                                 const RecordingContent& content,
                                                                 const McapWriterOptions& options,
                                                                 ExistingFile existing) {
  auto file = create_output_file(path, existing);
  if (!file) return tl::unexpected(file.error());
  return start(std::move(*file), path.string(), content, options);
}

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::start(std::unique_ptr<OutputFile> file,
                                                                std::string name,
                                                                const RecordingContent& content,
                                                                const McapWriterOptions& options) {
  std::unique_ptr<RecordingWriter> writer(
      new RecordingWriter(std::move(file), std::move(name), content, options));
  writer->describe(content);
  if (auto error = writer->outcome(writer->mcap_.failure()); !error) {
    return tl::unexpected(error.error());
  }
  return writer;
}

RecordingWriter::RecordingWriter(std::unique_ptr<OutputFile> file, std::string name,
                                 const RecordingContent& content, const McapWriterOptions& options)
    : mcap_(std::move(file), options), name_(std::move(name)), calibration_(content.calibration) {}

void RecordingWriter::describe(const RecordingContent& content) {
  mcap_.start();
  mcap::Metadata session{kSessionMetadata, content.session};
  session.entries["clock"] = "CLOCK_MONOTONIC";
  if (content.utc_offset)
    session.entries[kUtcOffsetKey] = std::to_string(content.utc_offset->count());
  mcap_.add_metadata(session);
  for (const RecordingAttachment& attachment : content.attachments) {
    mcap_.add_attachment({0, 0, attachment.name, attachment.media_type, attachment.content});
  }
  // What every rig delivers is described before anything happens; the rest where it first comes.
  for (const RecordingTopic topic :
       {RecordingTopic::kFrameInfo, RecordingTopic::kImage, RecordingTopic::kPackets,
        RecordingTopic::kPositions, RecordingTopic::kEdges, RecordingTopic::kDeviceStates}) {
    channel(topic);
  }
  if (!calibration_) return;
  channel(RecordingTopic::kCameraInfo);
  channel(RecordingTopic::kStaticTransforms);
}

std::uint16_t RecordingWriter::channel(RecordingTopic topic) {
  std::optional<std::uint16_t>& id = channels_[static_cast<std::size_t>(topic)];
  if (id) return *id;
  const TopicDescription& description = description_of(topic);
  auto schema = schemas_.find(description.type);
  if (schema == schemas_.end()) {
    const std::string type(description.type);
    schema = schemas_.emplace(type, mcap_.add_schema(type, "ros2msg", schema_text(type))).first;
  }
  id = mcap_.add_channel(schema->second, std::string(description.name), "cdr",
                         {{"offered_qos_profiles", offered_qos_profiles(description)}});
  return *id;
}

template <typename Append>
void RecordingWriter::message(RecordingTopic topic, HostTime published, Append append) {
  const std::uint16_t id = channel(topic);
  const std::uint32_t sequence = sequences_[static_cast<std::size_t>(topic)]++;
  append(mcap_.begin_message({id, sequence, log_time(now_), log_time(published)}));
  mcap_.end_message();
}

Result<void> RecordingWriter::write(const RigEvent& event) {
  now_ = arrival_of(event);
  if (!std::exchange(begun_, true)) write_static_transforms();
  const HostTime at = now_;
  if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event)) {
    write_frame(**frame);
  } else if (const auto* edge = std::get_if<Edge>(&event)) {
    message(RecordingTopic::kEdges, at, [&](Buffer& out) { append_edge(*edge, out); });
  } else if (const auto* packet = std::get_if<LidarPacket>(&event)) {
    message(RecordingTopic::kPackets, at, [&](Buffer& out) { append_scan(*packet, out); });
  } else if (const auto* position = std::get_if<PositionPacket>(&event)) {
    message(RecordingTopic::kPositions, at, [&](Buffer& out) { append_position(*position, out); });
  } else {
    const auto& change = std::get<DeviceStateChange>(event);
    message(RecordingTopic::kDeviceStates, at,
            [&](Buffer& out) { append_device_state(change, out); });
  }
  return outcome(mcap_.failure());
}

void RecordingWriter::write_frame(const CameraFrame& frame) {
  const HostTime published = frame.driver_time;
  message(RecordingTopic::kFrameInfo, published,
          [&](Buffer& out) { append_frame_info(frame, out); });
  if (frame.format == PixelFormat::kMjpeg) {
    message(RecordingTopic::kCompressedImage, published,
            [&](Buffer& out) { append_compressed_image(frame, out); });
  } else {
    message(RecordingTopic::kImage, published, [&](Buffer& out) { append_image(frame, out); });
  }
  if (!calibration_) return;
  message(RecordingTopic::kCameraInfo, published,
          [&](Buffer& out) { append_camera_info(calibration_->camera, published, out); });
}

void RecordingWriter::write_static_transforms() {
  if (!calibration_) return;
  message(RecordingTopic::kStaticTransforms, now_, [&](Buffer& out) {
    append_transform({now_, kCameraFrame, kLidarFrame, calibration_->T_camera_lidar}, out);
  });
}

Result<void> RecordingWriter::write(const RecordedPose& pose) {
  const auto say = [&](RecordingTopic topic, std::string_view parent,
                       const Eigen::Isometry3d& T_camera) {
    message(topic, pose.time, [&](Buffer& out) {
      append_pose({pose.time, parent, T_camera}, out);
    });
  };
  const auto tie = [&](std::string_view parent, std::string_view child,
                       const Eigen::Isometry3d& T) {
    message(RecordingTopic::kTransforms, pose.time, [&](Buffer& out) {
      append_transform({pose.time, parent, child, T}, out);
    });
  };
  say(RecordingTopic::kPoses, kOdometryFrame, pose.T_world_camera);
  tie(kOdometryFrame, kCameraFrame, pose.T_world_camera);
  if (pose.T_map_world) {
    say(RecordingTopic::kMapPoses, kMapFrame, *pose.T_map_world * pose.T_world_camera);
    tie(kMapFrame, kOdometryFrame, *pose.T_map_world);
  }
  return outcome(mcap_.failure());
}

Result<void> RecordingWriter::write(const RecordedSyncState& state) {
  message(RecordingTopic::kSyncStates, state.exposure_middle,
          [&](Buffer& out) { append_sync_state(state, out); });
  return outcome(mcap_.failure());
}

Result<void> RecordingWriter::flush() { return outcome(mcap_.flush()); }

Result<void> RecordingWriter::close() { return outcome(mcap_.close()); }

Result<void> RecordingWriter::outcome(std::error_code error) const {
  if (!error) return {};
  const char* fix = error == std::errc::no_space_on_device ? "free space or record to another disk"
                                                           : "check the disk and its connection";
  return fail(ErrorCode::kUnreadable,
              fmt::format("{}: cannot be written: {}; {}. What was written before is readable.",
                          name_, error.message(), fix));
}

}  // namespace sparsight
