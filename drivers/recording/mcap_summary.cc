#include "drivers/recording/mcap_summary.h"

#include <algorithm>

#include "drivers/recording/byte_reader.h"
#include "drivers/recording/crc32.h"
#include "drivers/recording/mcap_parsing.h"

namespace sparsight {
namespace {

using mcap::Opcode;

// Far above any chunk, attachment or index of hours; a damaged length must not fill the memory.
constexpr std::uint64_t kMaxRecordBytes = 256ULL << 20;
constexpr std::uint64_t kMaxSummaryBytes = 256ULL << 20;
constexpr std::uint64_t kTailBytes = mcap::kFooterBytes + mcap::kMagic.size();

bool has_magic(InputFile& file, std::uint64_t offset) {
  std::array<std::uint8_t, mcap::kMagic.size()> bytes{};
  return file.read(offset, bytes) && bytes == mcap::kMagic;
}

template <typename Record>
bool keep(Bytes content, std::vector<Record>& records) {
  Record record;
  if (!parse(content, record)) return false;
  records.push_back(std::move(record));
  return true;
}

template <typename Record>
bool keep_by_id(Bytes content, std::map<std::uint16_t, Record>& records) {
  Record record;
  if (!parse(content, record)) return false;
  records.try_emplace(record.id, record);
  return true;
}

bool take_summary_record(Opcode opcode, Bytes content, McapSummary& summary) {
  switch (opcode) {
    case Opcode::kSchema:
      return keep_by_id(content, summary.schemas);
    case Opcode::kChannel:
      return keep_by_id(content, summary.channels);
    case Opcode::kChunkIndex:
      return keep(content, summary.chunks);
    case Opcode::kAttachmentIndex:
      return keep(content, summary.attachments);
    case Opcode::kMetadataIndex:
      return keep(content, summary.metadata);
    case Opcode::kStatistics:
      return parse(content, summary.statistics);
    default:
      return true;
  }
}

// The footer, if the file ends with one whose checksum fits what is before it.
std::optional<mcap::Footer> read_footer(InputFile& file, mcap::Buffer& summary_bytes) {
  if (file.size() < kTailBytes || !has_magic(file, file.size() - mcap::kMagic.size())) return {};
  const std::uint64_t start = file.size() - kTailBytes;
  const std::optional<RecordPlace> place = record_at(file, start);
  mcap::Buffer content;
  mcap::Footer footer;
  if (!place || place->opcode != Opcode::kFooter ||
      place->end() + mcap::kMagic.size() != file.size() || !read_content(file, *place, content) ||
      !parse(content, footer)) {
    return {};
  }
  if (footer.summary_start == 0 || footer.summary_start > start ||
      start - footer.summary_start > kMaxSummaryBytes) {
    return {};
  }
  const std::uint64_t checked = start + mcap::kFooterBytes - 4;
  summary_bytes.resize(checked - footer.summary_start);
  if (!file.read(footer.summary_start, summary_bytes)) return {};
  if (footer.summary_crc != 0 && footer.summary_crc != crc32_of(summary_bytes)) return {};
  summary_bytes.resize(start - footer.summary_start);
  return footer;
}

bool read_index(InputFile& file, McapSummary& summary) {
  mcap::Buffer bytes;
  const std::optional<mcap::Footer> footer = read_footer(file, bytes);
  if (!footer) return false;
  ByteReader reader(bytes);
  while (reader.left() > 0) {
    const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
    const Bytes content = reader.take(reader.number<std::uint64_t>());
    if (!reader.ok() || !take_summary_record(opcode, content, summary)) return false;
  }
  summary.data_end = footer->summary_start;
  summary.indexed = summary.ended = true;
  return !summary.chunks.empty() || summary.statistics.message_count == 0;
}

void add_chunk(InputFile& file, const RecordPlace& place, McapSummary& summary) {
  RecordPlace head = place;  // its times and sizes, without its records
  head.length = std::min<std::uint64_t>(place.length, 64);
  mcap::Buffer content;
  mcap::Chunk chunk;
  if (!read_content(file, head, content) || !mcap::parse_chunk(content, chunk)) return;
  mcap::ChunkIndex index{chunk.start_time, chunk.end_time, place.content - mcap::kPrefixBytes,
                         place.length + mcap::kPrefixBytes};
  index.compression = chunk.compression;
  index.compressed_size = chunk.compressed_size;
  index.uncompressed_size = chunk.uncompressed_size;
  mcap::Statistics& statistics = summary.statistics;
  const bool first = summary.chunks.empty();
  statistics.start_time =
      first ? index.start_time : std::min(statistics.start_time, index.start_time);
  statistics.end_time = first ? index.end_time : std::max(statistics.end_time, index.end_time);
  summary.chunks.push_back(std::move(index));
}

void add_message_index(Bytes content, McapSummary& summary) {
  mcap::MessageIndex index;
  if (!parse(content, index)) return;
  summary.statistics.message_count += index.entries.size();
  summary.statistics.channel_message_counts[index.channel_id] += index.entries.size();
}

void add_attachment(Bytes content, const RecordPlace& place, McapSummary& summary) {
  mcap::Attachment attachment;
  if (!parse(content, attachment)) return;
  summary.attachments.push_back(
      {place.content - mcap::kPrefixBytes, place.length + mcap::kPrefixBytes, attachment.log_time,
       attachment.create_time, attachment.data.size(), attachment.name, attachment.media_type});
}

void add_metadata(Bytes content, const RecordPlace& place, McapSummary& summary) {
  mcap::Metadata metadata;
  if (!parse(content, metadata)) return;
  summary.metadata.push_back(
      {place.content - mcap::kPrefixBytes, place.length + mcap::kPrefixBytes, metadata.name});
}

void add_record(InputFile& file, const RecordPlace& place, McapSummary& summary) {
  if (place.opcode == Opcode::kChunk) return add_chunk(file, place, summary);
  if (place.opcode == Opcode::kMessage) {
    ++summary.statistics.message_count;
    return;
  }
  mcap::Buffer content;
  if (!read_content(file, place, content)) return;
  if (place.opcode == Opcode::kMessageIndex) add_message_index(content, summary);
  if (place.opcode == Opcode::kSchema) keep_by_id(content, summary.schemas);
  if (place.opcode == Opcode::kChannel) keep_by_id(content, summary.channels);
  if (place.opcode == Opcode::kAttachment) add_attachment(content, place, summary);
  if (place.opcode == Opcode::kMetadata) add_metadata(content, place, summary);
}

void walk(InputFile& file, McapSummary& summary) {
  std::uint64_t offset = summary.data_start;
  while (const std::optional<RecordPlace> place = record_at(file, offset)) {
    summary.ended = place->opcode == Opcode::kDataEnd || place->opcode == Opcode::kFooter;
    if (summary.ended || !place->whole) break;
    add_record(file, *place, summary);
    offset = place->end();
  }
  summary.data_end = offset;
}

}  // namespace

std::optional<RecordPlace> record_at(InputFile& file, std::uint64_t offset) {
  std::array<std::uint8_t, mcap::kPrefixBytes> prefix{};
  if (!file.read(offset, prefix)) return std::nullopt;
  ByteReader reader(prefix);
  RecordPlace place{static_cast<Opcode>(reader.number<std::uint8_t>()), offset + prefix.size()};
  place.length = reader.number<std::uint64_t>();
  place.whole = place.length <= file.size() - place.content;
  return place;
}

bool read_content(InputFile& file, const RecordPlace& place, mcap::Buffer& out) {
  const std::uint64_t count = std::min(place.length, file.size() - place.content);
  if (count > kMaxRecordBytes) return false;
  out.resize(count);
  return file.read(place.content, out);
}

std::optional<McapSummary> read_summary(InputFile& file) {
  if (!has_magic(file, 0)) return std::nullopt;
  const std::optional<RecordPlace> place = record_at(file, mcap::kMagic.size());
  mcap::Buffer content;
  McapSummary start;
  if (!place || place->opcode != Opcode::kHeader || !place->whole ||
      !read_content(file, *place, content) || !parse(content, start.header)) {
    return std::nullopt;
  }
  start.data_start = place->end();
  McapSummary indexed = start;
  if (read_index(file, indexed)) return indexed;
  walk(file, start);
  return start;
}

}  // namespace sparsight
