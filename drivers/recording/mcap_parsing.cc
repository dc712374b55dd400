#include "drivers/recording/mcap_parsing.h"

#include <algorithm>

#include "drivers/recording/byte_reader.h"
#include "drivers/recording/crc32.h"

namespace sparsight::mcap {
namespace {

bool parse_map(Bytes bytes, TextMap& out) {
  ByteReader reader(bytes);
  out.clear();
  while (reader.ok() && reader.left() > 0) {
    std::string key(reader.text());
    out[std::move(key)] = reader.text();
  }
  return reader.ok();
}

bool parse_map(Bytes bytes, std::map<std::uint16_t, std::uint64_t>& out) {
  ByteReader reader(bytes);
  out.clear();
  while (reader.ok() && reader.left() > 0) {
    const auto key = reader.number<std::uint16_t>();
    out[key] = reader.number<std::uint64_t>();
  }
  return reader.ok();
}

}  // namespace

bool parse(Bytes content, Header& out) {
  ByteReader reader(content);
  out.profile = reader.text();
  out.library = reader.text();
  return reader.ok();
}

bool parse(Bytes content, Footer& out) {
  ByteReader reader(content);
  out.summary_start = reader.number<std::uint64_t>();
  out.summary_offset_start = reader.number<std::uint64_t>();
  out.summary_crc = reader.number<std::uint32_t>();
  return reader.ok();
}

bool parse(Bytes content, Schema& out) {
  ByteReader reader(content);
  out.id = reader.number<std::uint16_t>();
  out.name = reader.text();
  out.encoding = reader.text();
  out.data = reader.text();
  return reader.ok() && out.id != 0;
}

bool parse(Bytes content, Channel& out) {
  ByteReader reader(content);
  out.id = reader.number<std::uint16_t>();
  out.schema_id = reader.number<std::uint16_t>();
  out.topic = reader.text();
  out.message_encoding = reader.text();
  return parse_map(reader.prefixed(), out.metadata) && reader.ok();
}

bool parse(Bytes content, Message& out) {
  ByteReader reader(content);
  out.channel_id = reader.number<std::uint16_t>();
  out.sequence = reader.number<std::uint32_t>();
  out.log_time = reader.number<std::uint64_t>();
  out.publish_time = reader.number<std::uint64_t>();
  out.data = reader.take(reader.left());
  return reader.ok();
}

bool parse_chunk(Bytes content, Chunk& out) {
  ByteReader reader(content);
  out.start_time = reader.number<std::uint64_t>();
  out.end_time = reader.number<std::uint64_t>();
  out.uncompressed_size = reader.number<std::uint64_t>();
  out.uncompressed_crc = reader.number<std::uint32_t>();
  out.compression = reader.text();
  out.compressed_size = reader.number<std::uint64_t>();
  out.records = reader.take(std::min<std::uint64_t>(out.compressed_size, reader.left()));
  return reader.ok();
}

bool parse(Bytes content, MessageIndex& out) {
  ByteReader reader(content);
  out.channel_id = reader.number<std::uint16_t>();
  ByteReader entries(reader.prefixed());
  out.entries.clear();
  while (entries.ok() && entries.left() > 0) {
    const auto time = entries.number<std::uint64_t>();
    out.entries.emplace_back(time, entries.number<std::uint64_t>());
  }
  return reader.ok() && entries.ok();
}

bool parse(Bytes content, ChunkIndex& out) {
  ByteReader reader(content);
  out.start_time = reader.number<std::uint64_t>();
  out.end_time = reader.number<std::uint64_t>();
  out.offset = reader.number<std::uint64_t>();
  out.length = reader.number<std::uint64_t>();
  const bool offsets = parse_map(reader.prefixed(), out.message_index_offsets);
  out.message_index_length = reader.number<std::uint64_t>();
  out.compression = reader.text();
  out.compressed_size = reader.number<std::uint64_t>();
  out.uncompressed_size = reader.number<std::uint64_t>();
  return offsets && reader.ok();
}

bool parse(Bytes content, Attachment& out) {
  ByteReader reader(content);
  out.log_time = reader.number<std::uint64_t>();
  out.create_time = reader.number<std::uint64_t>();
  out.name = reader.text();
  out.media_type = reader.text();
  out.data = text_of(reader.take(reader.number<std::uint64_t>()));
  const std::size_t checked = content.size() - reader.left();
  const auto crc = reader.number<std::uint32_t>();
  return reader.ok() && (crc == 0 || crc == crc32_of(content.first(checked)));
}

bool parse(Bytes content, AttachmentIndex& out) {
  ByteReader reader(content);
  out.offset = reader.number<std::uint64_t>();
  out.length = reader.number<std::uint64_t>();
  out.log_time = reader.number<std::uint64_t>();
  out.create_time = reader.number<std::uint64_t>();
  out.data_size = reader.number<std::uint64_t>();
  out.name = reader.text();
  out.media_type = reader.text();
  return reader.ok();
}

bool parse(Bytes content, Statistics& out) {
  ByteReader reader(content);
  out.message_count = reader.number<std::uint64_t>();
  out.schema_count = reader.number<std::uint16_t>();
  out.channel_count = reader.number<std::uint32_t>();
  out.attachment_count = reader.number<std::uint32_t>();
  out.metadata_count = reader.number<std::uint32_t>();
  out.chunk_count = reader.number<std::uint32_t>();
  out.start_time = reader.number<std::uint64_t>();
  out.end_time = reader.number<std::uint64_t>();
  return parse_map(reader.prefixed(), out.channel_message_counts) && reader.ok();
}

bool parse(Bytes content, Metadata& out) {
  ByteReader reader(content);
  out.name = reader.text();
  return parse_map(reader.prefixed(), out.entries) && reader.ok();
}

bool parse(Bytes content, MetadataIndex& out) {
  ByteReader reader(content);
  out.offset = reader.number<std::uint64_t>();
  out.length = reader.number<std::uint64_t>();
  out.name = reader.text();
  return reader.ok();
}

bool parse(Bytes content, DataEnd& out) {
  ByteReader reader(content);
  out.data_section_crc = reader.number<std::uint32_t>();
  return reader.ok();
}

}  // namespace sparsight::mcap
