#include "drivers/recording/mcap_encoding.h"

#include "drivers/recording/byte_writer.h"
#include "drivers/recording/crc32.h"

namespace sparsight::mcap {
namespace {

// A map or array is preceded by its length in bytes.
template <typename Fill>
void append_sized(ByteWriter& writer, Fill fill) {
  const std::size_t start = writer.position();
  writer.number(std::uint32_t{0});
  fill();
  writer.patch(start, static_cast<std::uint32_t>(writer.position() - start - 4));
}

void append_map(ByteWriter& writer, const TextMap& map) {
  append_sized(writer, [&] {
    for (const auto& [key, value] : map) {
      writer.text(key);
      writer.text(value);
    }
  });
}

void append_map(ByteWriter& writer, const std::map<std::uint16_t, std::uint64_t>& map) {
  append_sized(writer, [&] {
    for (const auto& [key, value] : map) {
      writer.number(key);
      writer.number(value);
    }
  });
}

}  // namespace

RecordScope::RecordScope(Buffer& out, Opcode opcode) : out_(out), start_(out.size()) {
  ByteWriter writer(out);
  writer.number(static_cast<std::uint8_t>(opcode));
  writer.number(std::uint64_t{0});
}

RecordScope::~RecordScope() {
  ByteWriter(out_).patch(start_ + 1, std::uint64_t{out_.size() - start_ - kPrefixBytes});
}

void append(const Header& header, Buffer& out) {
  const RecordScope record(out, Opcode::kHeader);
  ByteWriter writer(out);
  writer.text(header.profile);
  writer.text(header.library);
}

void append(const Schema& schema, Buffer& out) {
  const RecordScope record(out, Opcode::kSchema);
  ByteWriter writer(out);
  writer.number(schema.id);
  writer.text(schema.name);
  writer.text(schema.encoding);
  writer.text(schema.data);
}

void append(const Channel& channel, Buffer& out) {
  const RecordScope record(out, Opcode::kChannel);
  ByteWriter writer(out);
  writer.number(channel.id);
  writer.number(channel.schema_id);
  writer.text(channel.topic);
  writer.text(channel.message_encoding);
  append_map(writer, channel.metadata);
}

void append(const MessageIndex& index, Buffer& out) {
  const RecordScope record(out, Opcode::kMessageIndex);
  ByteWriter writer(out);
  writer.number(index.channel_id);
  append_sized(writer, [&] {
    for (const auto& [time, offset] : index.entries) {
      writer.number(time);
      writer.number(offset);
    }
  });
}

void append(const ChunkIndex& index, Buffer& out) {
  const RecordScope record(out, Opcode::kChunkIndex);
  ByteWriter writer(out);
  writer.number(index.start_time);
  writer.number(index.end_time);
  writer.number(index.offset);
  writer.number(index.length);
  append_map(writer, index.message_index_offsets);
  writer.number(index.message_index_length);
  writer.text(index.compression);
  writer.number(index.compressed_size);
  writer.number(index.uncompressed_size);
}

void append(const Attachment& attachment, Buffer& out) {
  const RecordScope record(out, Opcode::kAttachment);
  ByteWriter writer(out);
  const std::size_t start = writer.position();
  writer.number(attachment.log_time);
  writer.number(attachment.create_time);
  writer.text(attachment.name);
  writer.text(attachment.media_type);
  writer.number(std::uint64_t{attachment.data.size()});
  writer.bytes(bytes_of(attachment.data));
  writer.number(crc32_of(Bytes(out).subspan(start)));
}

void append(const AttachmentIndex& index, Buffer& out) {
  const RecordScope record(out, Opcode::kAttachmentIndex);
  ByteWriter writer(out);
  writer.number(index.offset);
  writer.number(index.length);
  writer.number(index.log_time);
  writer.number(index.create_time);
  writer.number(index.data_size);
  writer.text(index.name);
  writer.text(index.media_type);
}

void append(const Statistics& statistics, Buffer& out) {
  const RecordScope record(out, Opcode::kStatistics);
  ByteWriter writer(out);
  writer.number(statistics.message_count);
  writer.number(statistics.schema_count);
  writer.number(statistics.channel_count);
  writer.number(statistics.attachment_count);
  writer.number(statistics.metadata_count);
  writer.number(statistics.chunk_count);
  writer.number(statistics.start_time);
  writer.number(statistics.end_time);
  append_map(writer, statistics.channel_message_counts);
}

void append(const Metadata& metadata, Buffer& out) {
  const RecordScope record(out, Opcode::kMetadata);
  ByteWriter writer(out);
  writer.text(metadata.name);
  append_map(writer, metadata.entries);
}

void append(const MetadataIndex& index, Buffer& out) {
  const RecordScope record(out, Opcode::kMetadataIndex);
  ByteWriter writer(out);
  writer.number(index.offset);
  writer.number(index.length);
  writer.text(index.name);
}

void append(const SummaryOffset& offset, Buffer& out) {
  const RecordScope record(out, Opcode::kSummaryOffset);
  ByteWriter writer(out);
  writer.number(static_cast<std::uint8_t>(offset.group));
  writer.number(offset.start);
  writer.number(offset.length);
}

void append(const DataEnd& end, Buffer& out) {
  const RecordScope record(out, Opcode::kDataEnd);
  ByteWriter(out).number(end.data_section_crc);
}

void append_footer(const Footer& footer, Buffer& out) {
  ByteWriter writer(out);
  writer.number(static_cast<std::uint8_t>(Opcode::kFooter));
  writer.number(std::uint64_t{kFooterBytes - kPrefixBytes});
  writer.number(footer.summary_start);
  writer.number(footer.summary_offset_start);
  writer.number(crc32_of(out));
}

void append_message_head(const Message& message, Buffer& out) {
  ByteWriter writer(out);
  writer.number(message.channel_id);
  writer.number(message.sequence);
  writer.number(message.log_time);
  writer.number(message.publish_time);
}

void append_chunk_head(const Chunk& chunk, Buffer& out) {
  ByteWriter writer(out);
  writer.number(static_cast<std::uint8_t>(Opcode::kChunk));
  const std::size_t length = writer.position();
  writer.number(std::uint64_t{0});
  writer.number(chunk.start_time);
  writer.number(chunk.end_time);
  writer.number(chunk.uncompressed_size);
  writer.number(chunk.uncompressed_crc);
  writer.text(chunk.compression);
  writer.number(std::uint64_t{chunk.records.size()});
  writer.patch(length, std::uint64_t{writer.position() - length - 8 + chunk.records.size()});
}

}  // namespace sparsight::mcap
