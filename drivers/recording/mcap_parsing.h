#pragma once

#include "drivers/recording/mcap_records.h"

namespace sparsight::mcap {

// Each reads the content of a record, without opcode and length; false if it does not hold what its
// kind must. Fields that a later version added behind are passed over, as the specification asks.
bool parse(Bytes content, Header& out);
bool parse(Bytes content, Footer& out);
bool parse(Bytes content, Schema& out);
bool parse(Bytes content, Channel& out);
bool parse(Bytes content, Message& out);
bool parse(Bytes content, MessageIndex& out);
bool parse(Bytes content, ChunkIndex& out);
bool parse(Bytes content, Attachment& out);  // false also if its CRC is not that of its bytes
bool parse(Bytes content, AttachmentIndex& out);
bool parse(Bytes content, Statistics& out);
bool parse(Bytes content, Metadata& out);
bool parse(Bytes content, MetadataIndex& out);
bool parse(Bytes content, DataEnd& out);

// A chunk of which the end may be missing: `records` holds what is there of `compressed_size`.
bool parse_chunk(Bytes content, Chunk& out);

}  // namespace sparsight::mcap
