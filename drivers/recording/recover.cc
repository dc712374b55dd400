#include "drivers/recording/recover.h"

#include <fmt/format.h>

#include <map>
#include <system_error>
#include <utility>

#include "drivers/recording/mcap_writer.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

McapWriterOptions options_like(const McapSummary& summary) {
  McapWriterOptions options;
  options.profile = summary.header.profile;
  options.library = summary.header.library;
  options.sync_chunks = false;  // it appears under its name only when all of it is on the disk
  const std::optional<Compression> compression =
      summary.chunks.empty() ? std::nullopt : compression_of(summary.chunks.front().compression);
  options.compression = compression.value_or(Compression::kNone);
  return options;
}

// Copies by the description of each message: identifiers are given anew.
class Copy {
 public:
  Copy(McapReader& reader, McapWriter& writer) : reader_(reader), writer_(writer) {}

  void attachments(RecoveryReport& report) {
    for (const mcap::MetadataIndex& index : reader_.summary().metadata) {
      if (auto metadata = reader_.metadata(index)) writer_.add_metadata(*metadata);
    }
    for (const mcap::AttachmentIndex& index : reader_.summary().attachments) {
      const auto attachment = reader_.attachment(index);
      if (!attachment) continue;
      writer_.add_attachment(*attachment);
      ++report.attachments;
    }
  }

  void messages(RecoveryReport& report) {
    std::uint64_t first = UINT64_MAX;
    std::uint64_t last = 0;
    while (const std::optional<mcap::Message> message = reader_.next()) {
      if (writer_.failure()) return;
      mcap::Message head = *message;
      head.channel_id = channel(message->channel_id);
      mcap::Buffer& out = writer_.begin_message(head);
      out.insert(out.end(), message->data.begin(), message->data.end());
      writer_.end_message();
      first = std::min(first, message->log_time);
      last = std::max(last, message->log_time);
      ++report.messages;
    }
    if (report.messages > 0) report.duration = std::chrono::nanoseconds(last - first);
  }

 private:
  std::uint16_t channel(std::uint16_t id) {
    const auto known = channels_.find(id);
    if (known != channels_.end()) return known->second;
    const mcap::Channel& old = reader_.summary().channels.at(id);
    return channels_[id] = writer_.add_channel(schema(old.schema_id), old.topic,
                                               old.message_encoding, old.metadata);
  }

  std::uint16_t schema(std::uint16_t id) {
    const auto known = schemas_.find(id);
    if (known != schemas_.end()) return known->second;
    const auto old = reader_.summary().schemas.find(id);
    if (old == reader_.summary().schemas.end()) return 0;  // a message without schema
    const mcap::Schema& schema = old->second;
    return schemas_[id] = writer_.add_schema(schema.name, schema.encoding, schema.data);
  }

  McapReader& reader_;
  McapWriter& writer_;
  std::map<std::uint16_t, std::uint16_t> schemas_;
  std::map<std::uint16_t, std::uint16_t> channels_;
};

Result<RecoveryReport> copy_to(McapReader& reader, const fs::path& partial) {
  auto file = create_output_file(partial, ExistingFile::kReplace);
  if (!file) return tl::unexpected(file.error());
  McapWriter writer(std::move(*file), options_like(reader.summary()));
  writer.start();
  RecoveryReport report{reader.summary().indexed};
  Copy copy(reader, writer);
  copy.attachments(report);
  copy.messages(report);
  if (const std::error_code error = writer.close()) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be written: {}; free space, or name "
                            "an output on another disk",
                            partial.string(), error.message()));
  }
  report.bytes_read = reader.file_size();
  report.bytes_written = writer.bytes_written();
  report.faults = reader.faults();
  return report;
}

}  // namespace

Result<RecoveryReport> recover_recording(const fs::path& damaged, const fs::path& output) {
  auto input = open_input_file(damaged);
  if (!input) return tl::unexpected(input.error());
  auto reader = McapReader::open(std::move(*input), damaged.string());
  if (!reader) return tl::unexpected(reader.error());
  std::error_code error;
  if (fs::exists(output, error)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: exists already; name an output that does not", output.string()));
  }
  fs::path partial = output;
  partial += ".partial";
  auto report = copy_to(**reader, partial);
  if (report) {
    fs::rename(partial, output, error);
    if (error) {
      report = fail(ErrorCode::kUnreadable,
                    fmt::format("{}: cannot be renamed: {}", partial.string(), error.message()));
    }
  }
  if (!report) fs::remove(partial, error);
  return report;
}

}  // namespace sparsight
