#include "drivers/recording/recording_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "drivers/recording/recording_writer.h"

namespace sparsight {
namespace {

// Some four seconds of a rig: events that all claim one time must not fill the memory.
constexpr std::size_t kMaxHeldEvents = 4096;
constexpr std::size_t kMaxHeldBytes = std::size_t{128} << 20;

HostTime on_host_clock(std::uint64_t log_time) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::int64_t>::max();
  return HostTime(std::chrono::nanoseconds(static_cast<std::int64_t>(std::min(log_time, kLast))));
}

std::size_t frame_bytes(const RigEvent& event) {
  const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event);
  return frame == nullptr ? 0 : (*frame)->bytes.size();
}

std::optional<std::chrono::nanoseconds> utc_offset(const mcap::TextMap& session) {
  const auto entry = session.find(kUtcOffsetKey);
  if (entry == session.end()) return std::nullopt;
  const std::string& text = entry->second;
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::chrono::nanoseconds(count);
}

}  // namespace

Result<std::unique_ptr<RecordingSource>> RecordingSource::open(const std::filesystem::path& file,
                                                               const RecordingOptions& options) {
  auto input = open_input_file(file);
  if (!input) return tl::unexpected(input.error());
  return open(std::move(*input), file.string(), options);
}

Result<std::unique_ptr<RecordingSource>> RecordingSource::open(std::unique_ptr<InputFile> file,
                                                               const std::string& name,
                                                               const RecordingOptions& options) {
  auto reader = McapReader::open(std::move(file), name);
  if (!reader) return tl::unexpected(reader.error());
  return std::unique_ptr<RecordingSource>(new RecordingSource(std::move(*reader), name, options));
}

RecordingSource::RecordingSource(std::unique_ptr<McapReader> reader, std::string name,
                                 const RecordingOptions& options)
    : reader_(std::move(reader)), options_(options) {
  describe(name);
}

void RecordingSource::describe(const std::string& name) {
  const McapSummary& summary = reader_->summary();
  info_.file = name;
  info_.bytes = reader_->file_size();
  info_.first = on_host_clock(summary.statistics.start_time);
  info_.last = on_host_clock(summary.statistics.end_time);
  info_.indexed = summary.indexed;
  info_.truncated = !summary.ended;
  for (const auto& [id, count] : summary.statistics.channel_message_counts) {
    const auto channel = summary.channels.find(id);
    if (channel != summary.channels.end()) info_.messages[channel->second.topic] += count;
  }
  for (const mcap::AttachmentIndex& attachment : summary.attachments) {
    info_.attachments.push_back(attachment.name);
  }
  for (const mcap::MetadataIndex& index : summary.metadata) {
    if (index.name != kSessionMetadata) continue;
    if (auto metadata = reader_->metadata(index)) info_.session = metadata->entries;
  }
  info_.utc_offset = utc_offset(info_.session);
}

std::optional<RigEvent> RecordingSource::next() {
  while (!holds_enough() && read_more()) {
  }
  if (held_.empty()) return std::nullopt;
  auto first = held_.extract(held_.begin());
  held_bytes_ -= frame_bytes(first.mapped());
  return std::move(first.mapped());
}

bool RecordingSource::holds_enough() const {
  if (held_.empty()) return false;
  if (held_.size() >= kMaxHeldEvents || held_bytes_ >= kMaxHeldBytes) return true;
  const HostTime first = held_.begin()->first;
  // A damaged time may be anywhere in 64 bits.
  if (first > HostTime::max() - options_.reorder_window) return false;
  return held_.rbegin()->first >= first + options_.reorder_window;
}

bool RecordingSource::read_more() {
  const std::optional<mcap::Message> message = reader_->next();
  if (!message) return false;
  const std::optional<RecordingTopic> topic = topic_of(message->channel_id);
  if (!topic) return true;
  decoded_.clear();
  if (!decoder_.decode(*topic, *message, decoded_)) ++refused_messages_;
  for (RigEvent& event : decoded_) hold(std::move(event));
  return true;
}

void RecordingSource::hold(RigEvent event) {
  held_bytes_ += frame_bytes(event);
  const HostTime arrival = arrival_of(event);
  held_.emplace(arrival, std::move(event));
}

std::optional<RecordingTopic> RecordingSource::topic_of(std::uint16_t channel_id) {
  const auto known = topics_.find(channel_id);
  if (known != topics_.end()) return known->second;
  const McapSummary& summary = reader_->summary();
  const mcap::Channel& channel = summary.channels.at(channel_id);
  const auto schema = summary.schemas.find(channel.schema_id);
  std::optional<RecordingTopic> topic;
  if (schema != summary.schemas.end() && channel.message_encoding == "cdr") {
    topic = recording_topic(channel.topic, schema->second.name);
  }
  topics_[channel_id] = topic;
  return topic;
}

Result<std::string> RecordingSource::attachment(std::string_view name) {
  const auto& all = reader_->summary().attachments;
  const auto index = std::ranges::find(all, name, &mcap::AttachmentIndex::name);
  if (index == all.end()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: holds no attachment '{}'{}", info_.file, name,
                            info_.truncated ? "; the file is cut off before it"
                                            : ": it was not recorded by sparsight"));
  }
  auto attachment = reader_->attachment(*index);
  if (!attachment) return tl::unexpected(attachment.error());
  return std::move(attachment->data);
}

}  // namespace sparsight
