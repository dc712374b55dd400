#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "drivers/recording/input_file.h"
#include "drivers/recording/mcap_records.h"

namespace sparsight {

// What an MCAP file says of itself without its messages being read.
struct McapSummary {
  mcap::Header header;
  std::map<std::uint16_t, mcap::Schema> schemas;
  std::map<std::uint16_t, mcap::Channel> channels;
  std::vector<mcap::ChunkIndex> chunks;
  std::vector<mcap::AttachmentIndex> attachments;
  std::vector<mcap::MetadataIndex> metadata;
  mcap::Statistics statistics;
  std::uint64_t data_start = 0;  // the first record after the header
  std::uint64_t data_end = 0;    // where records stop, or stop being whole
  bool indexed = false;          // by the file itself; else gathered by walking over it
  bool ended = false;            // the data section was closed; else the recording was cut off
};

// A record in place: its content is not read yet.
struct RecordPlace {
  mcap::Opcode opcode{};
  std::uint64_t content = 0;  // offset in the file
  std::uint64_t length = 0;   // as announced; `whole` if the file is long enough for it
  bool whole = false;
  std::uint64_t end() const { return content + length; }
};

// The record at an offset; nothing where not even its length is there.
std::optional<RecordPlace> record_at(InputFile& file, std::uint64_t offset);

// The content of a record, or as much of it as the file has; false if it is absurdly long or cannot
// be read.
bool read_content(InputFile& file, const RecordPlace& place, mcap::Buffer& out);

// The header, and the index at the end if it is there and its checksum fits, else what a walk over
// the records finds. Nothing if the file does not start as MCAP.
std::optional<McapSummary> read_summary(InputFile& file);

}  // namespace sparsight
