#pragma once

#include <cstddef>

#include "drivers/recording/mcap_records.h"

namespace sparsight::mcap {

// A record whose content is appended while this lives; its length is put in at the end.
class RecordScope {
 public:
  RecordScope(Buffer& out, Opcode opcode);
  ~RecordScope();
  RecordScope(const RecordScope&) = delete;
  RecordScope& operator=(const RecordScope&) = delete;

 private:
  Buffer& out_;
  const std::size_t start_;
};

// Each appends the whole record.
void append(const Header& header, Buffer& out);
void append(const Schema& schema, Buffer& out);
void append(const Channel& channel, Buffer& out);
void append(const MessageIndex& index, Buffer& out);
void append(const ChunkIndex& index, Buffer& out);
void append(const Attachment& attachment, Buffer& out);
void append(const AttachmentIndex& index, Buffer& out);
void append(const Statistics& statistics, Buffer& out);
void append(const Metadata& metadata, Buffer& out);
void append(const MetadataIndex& index, Buffer& out);
void append(const SummaryOffset& offset, Buffer& out);
void append(const DataEnd& end, Buffer& out);

// The footer of a summary that starts at out[0]; it carries the CRC of both.
void append_footer(const Footer& footer, Buffer& out);

// All of a message but its data, which follows within the same record.
void append_message_head(const Message& message, Buffer& out);

// All of a chunk but its records, which follow.
void append_chunk_head(const Chunk& chunk, Buffer& out);

}  // namespace sparsight::mcap
