#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "drivers/recording/chunk_compression.h"
#include "drivers/recording/mcap_records.h"
#include "drivers/recording/output_file.h"

namespace sparsight {

struct McapWriterOptions {
  std::string profile = "ros2";
  std::string library = "sparsight";
  Compression compression = Compression::kLz4;
  // What a power cut may take: a chunk is written out before either is exceeded.
  std::size_t chunk_bytes = std::size_t{4} << 20;
  std::chrono::milliseconds chunk_duration{500};  // by log time
  bool sync_chunks = true;                        // each is on the disk before the next begins
};

// Writes an MCAP file with chunks, indexes, statistics and checksums. Thread-bound.
//
// An error is final: the file is cut back to its last whole record, so that it stays readable, and
// every further call returns the same error. close() then still tries to write the index, for which
// the cut may have made room.
class McapWriter {
 public:
  McapWriter(std::unique_ptr<OutputFile> file, McapWriterOptions options);

  std::error_code start();

  // Outside chunks and at once, so that no damage to a chunk takes the meaning of later ones.
  std::uint16_t add_schema(std::string name, std::string encoding, std::string data);
  std::uint16_t add_channel(std::uint16_t schema_id, std::string topic,
                            std::string message_encoding, mcap::TextMap metadata);
  std::error_code add_attachment(const mcap::Attachment& attachment);
  std::error_code add_metadata(const mcap::Metadata& metadata);

  // The data of the message are whatever is appended to the returned buffer before end_message().
  mcap::Buffer& begin_message(const mcap::Message& head);
  std::error_code end_message();

  std::error_code flush();  // writes out the open chunk
  std::error_code close();  // and the index; nothing can be written afterwards

  std::error_code failure() const { return failure_; }
  std::uint64_t bytes_written() const { return end_; }
  std::uint64_t messages_written() const { return statistics_.message_count; }
  std::uint64_t messages_lost() const {  // to an error
    return accepted_ - statistics_.message_count - pending_messages_;
  }
  OutputFile& file() { return *file_; }

 private:
  using Entries = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  std::error_code put(Bytes bytes);
  std::error_code put_whole(const mcap::Buffer& record);
  void forget_chunk();
  std::error_code write_chunk();
  void count_chunk(const mcap::ChunkIndex& index);
  mcap::Buffer summary() const;

  const std::unique_ptr<OutputFile> file_;
  const McapWriterOptions options_;
  std::error_code failure_;
  bool closed_ = false;
  std::uint64_t end_ = 0;       // of the last whole record
  std::uint32_t data_crc_ = 0;  // of all before it

  mcap::Buffer records_;     // of the open chunk
  mcap::Buffer compressed_;  // reused
  mcap::Buffer outline_;     // reused: heads, indexes, small records
  std::size_t message_start_ = 0;
  std::size_t largest_message_ = 0;
  std::uint64_t pending_messages_ = 0;  // in the open chunk
  std::uint64_t accepted_ = 0;
  std::uint64_t chunk_start_time_ = 0;
  std::uint64_t chunk_end_time_ = 0;
  std::map<std::uint16_t, Entries> entries_;

  std::vector<mcap::Schema> schemas_;
  std::vector<mcap::Channel> channels_;
  std::vector<mcap::ChunkIndex> chunks_;
  std::vector<mcap::AttachmentIndex> attachments_;
  std::vector<mcap::MetadataIndex> metadata_;
  mcap::Statistics statistics_;
};

}  // namespace sparsight
