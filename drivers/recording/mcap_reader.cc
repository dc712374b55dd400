#include "drivers/recording/mcap_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "drivers/recording/byte_reader.h"
#include "drivers/recording/chunk_compression.h"
#include "drivers/recording/crc32.h"
#include "drivers/recording/mcap_parsing.h"

namespace sparsight {

using mcap::Opcode;

namespace {

// Ours hold 4 MiB; a few bytes that unpack to gigabytes are refused at this size.
constexpr std::uint64_t kMaxUnpackedBytes = 128ULL << 20;

}  // namespace

Result<std::unique_ptr<McapReader>> McapReader::open(std::unique_ptr<InputFile> file,
                                                     std::string name) {
  std::optional<McapSummary> summary = read_summary(*file);
  if (!summary) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: does not start as an MCAP file; is it a recording?", name));
  }
  return std::unique_ptr<McapReader>(
      new McapReader(std::move(file), std::move(name), std::move(*summary)));
}

McapReader::McapReader(std::unique_ptr<InputFile> file, std::string name, McapSummary summary)
    : file_(std::move(file)),
      name_(std::move(name)),
      summary_(std::move(summary)),
      offset_(summary_.data_start) {
  if (!summary_.indexed) return;
  for (const mcap::ChunkIndex& chunk : summary_.chunks) chunk_offsets_.push_back(chunk.offset);
  std::ranges::sort(chunk_offsets_);
}

std::optional<mcap::Message> McapReader::next() {
  for (;;) {
    if (auto message = next_in_chunk()) return message;
    const std::optional<RecordPlace> place = record_at(*file_, offset_);
    if (!place) {
      faults_.lost_its_place = faults_.lost_its_place || offset_ < summary_.data_end;
      return std::nullopt;
    }
    if (misplaced(*place)) {
      find_place_again();
      continue;
    }
    if (place->opcode == Opcode::kDataEnd || place->opcode == Opcode::kFooter) return std::nullopt;
    offset_ = place->whole ? place->end() : file_->size();
    if (auto message = take_outer(*place)) return message;
  }
}

std::optional<mcap::Message> McapReader::next_in_chunk() {
  while (!left_in_chunk_.empty()) {
    ByteReader reader(left_in_chunk_);
    const auto opcode = static_cast<Opcode>(reader.number<std::uint8_t>());
    const Bytes content = reader.take(reader.number<std::uint64_t>());
    left_in_chunk_ = left_in_chunk_.last(reader.left());
    if (!reader.ok()) break;  // cut off within this record
    if (opcode != Opcode::kMessage) {
      take_description(opcode, content);
    } else if (auto message = take_message(content)) {
      return message;
    }
  }
  left_in_chunk_ = {};
  return std::nullopt;
}

std::optional<mcap::Message> McapReader::take_outer(const RecordPlace& place) {
  if (place.opcode == Opcode::kChunk) {
    load_chunk(place);
    return std::nullopt;
  }
  const bool described = place.opcode == Opcode::kSchema || place.opcode == Opcode::kChannel;
  if (!place.whole || !(described || place.opcode == Opcode::kMessage)) return std::nullopt;
  if (!read_content(*file_, place, content_)) {
    ++faults_.damaged_records;
    return std::nullopt;
  }
  if (place.opcode == Opcode::kMessage) return take_message(content_);
  take_description(place.opcode, content_);
  return std::nullopt;
}

std::optional<mcap::Message> McapReader::take_message(Bytes content) {
  mcap::Message message;
  if (!parse(content, message)) {
    ++faults_.damaged_records;
  } else if (!summary_.channels.contains(message.channel_id)) {
    ++faults_.unknown_channels;
  } else {
    return message;
  }
  return std::nullopt;
}

// The first description of an id stands: the specification wants later ones to be equal.
void McapReader::take_description(Opcode opcode, Bytes content) {
  mcap::Schema schema;
  mcap::Channel channel;
  if (opcode == Opcode::kSchema && parse(content, schema)) {
    const auto id = schema.id;
    summary_.schemas.try_emplace(id, std::move(schema));
  } else if (opcode == Opcode::kChannel && parse(content, channel)) {
    const auto id = channel.id;
    summary_.channels.try_emplace(id, std::move(channel));
  } else {
    ++faults_.damaged_records;
  }
}

void McapReader::load_chunk(const RecordPlace& place) {
  mcap::Chunk chunk;
  left_in_chunk_ = {};
  if (!read_content(*file_, place, content_) || !mcap::parse_chunk(content_, chunk)) {
    if (place.whole) ++faults_.damaged_chunks;
    return;
  }
  const std::optional<Compression> compression = compression_of(chunk.compression);
  bool sound = compression.has_value() && chunk.uncompressed_size <= kMaxUnpackedBytes;
  Bytes records = chunk.records;
  if (sound && compression != Compression::kNone) {
    const bool whole = decompress(*compression, records, chunk.uncompressed_size, unpacked_);
    records = unpacked_;
    sound = whole || !place.whole;
  }
  if (sound && place.whole) {
    sound = records.size() == chunk.uncompressed_size &&
            (chunk.uncompressed_crc == 0 || chunk.uncompressed_crc == crc32_of(records));
  }
  if (!sound) {
    ++faults_.damaged_chunks;
    return;
  }
  left_in_chunk_ = records;
}

// By a damaged length: no record reaches over the start of a chunk that the index knows.
bool McapReader::misplaced(const RecordPlace& place) const {
  if (!summary_.indexed) return false;
  const auto next = std::ranges::upper_bound(chunk_offsets_, offset_);
  return !place.whole || (next != chunk_offsets_.end() && *next < place.end());
}

void McapReader::find_place_again() {
  const auto next = std::ranges::upper_bound(chunk_offsets_, offset_);
  ++faults_.damaged_records;
  offset_ = next == chunk_offsets_.end() ? file_->size() : *next;
}

void McapReader::seek(std::uint64_t log_time) {
  std::uint64_t next = UINT64_MAX;
  for (const mcap::ChunkIndex& chunk : summary_.chunks) {
    if (chunk.end_time >= log_time) next = std::min(next, chunk.offset);
  }
  left_in_chunk_ = {};
  if (!summary_.chunks.empty()) offset_ = next == UINT64_MAX ? summary_.data_end : next;
}

template <typename Record>
Result<Record> McapReader::record(Opcode opcode, std::uint64_t offset, const char* kind) {
  const std::optional<RecordPlace> place = record_at(*file_, offset);
  mcap::Buffer content;
  Record found;
  if (!place || !place->whole || place->opcode != opcode ||
      !read_content(*file_, *place, content) || !parse(content, found)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: the {} at byte {} is damaged", name_, kind, offset));
  }
  return found;
}

Result<mcap::Attachment> McapReader::attachment(const mcap::AttachmentIndex& index) {
  return record<mcap::Attachment>(Opcode::kAttachment, index.offset, "attachment");
}

Result<mcap::Metadata> McapReader::metadata(const mcap::MetadataIndex& index) {
  return record<mcap::Metadata>(Opcode::kMetadata, index.offset, "metadata record");
}

}  // namespace sparsight
