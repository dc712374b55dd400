#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/recording/input_file.h"
#include "drivers/recording/mcap_records.h"
#include "drivers/recording/mcap_summary.h"
#include "hal/result.h"

namespace sparsight {

// What a reader came across that it could not give.
struct McapFaults {
  std::uint64_t damaged_chunks = 0;    // checksum, compression or size wrong; left out
  std::uint64_t damaged_records = 0;   // of any other kind
  std::uint64_t unknown_channels = 0;  // messages on channels that nothing describes
  bool lost_its_place = false;         // nothing told where the next record is, or the disk refused
};

// Reads the messages of an MCAP file in the order they were written. No byte of it is trusted: what
// is damaged is left out and counted. Of a chunk that was cut off, the messages that are whole are
// still given. Thread-bound.
class McapReader {
 public:
  // `name` is for error messages.
  static Result<std::unique_ptr<McapReader>> open(std::unique_ptr<InputFile> file,
                                                  std::string name);

  const McapSummary& summary() const { return summary_; }
  const McapFaults& faults() const { return faults_; }
  std::uint64_t file_size() const { return file_->size(); }

  // The next message; its data stay until the next call. Its channel is in summary().
  std::optional<mcap::Message> next();

  // Goes on with the first chunk that holds anything at or after this time, if there is an index.
  void seek(std::uint64_t log_time);

  Result<mcap::Attachment> attachment(const mcap::AttachmentIndex& index);
  Result<mcap::Metadata> metadata(const mcap::MetadataIndex& index);

 private:
  McapReader(std::unique_ptr<InputFile> file, std::string name, McapSummary summary);

  std::optional<mcap::Message> next_in_chunk();
  std::optional<mcap::Message> take_outer(const RecordPlace& place);
  std::optional<mcap::Message> take_message(Bytes content);
  void take_description(mcap::Opcode opcode, Bytes content);
  void load_chunk(const RecordPlace& place);
  bool misplaced(const RecordPlace& place) const;
  void find_place_again();
  template <typename Record>
  Result<Record> record(mcap::Opcode opcode, std::uint64_t offset, const char* kind);

  const std::unique_ptr<InputFile> file_;
  const std::string name_;
  McapSummary summary_;
  McapFaults faults_;
  std::vector<std::uint64_t> chunk_offsets_;  // in their order, if the file has an index
  std::uint64_t offset_ = 0;                  // of the next record outside a chunk
  mcap::Buffer content_;
  mcap::Buffer unpacked_;
  Bytes left_in_chunk_;
};

}  // namespace sparsight
