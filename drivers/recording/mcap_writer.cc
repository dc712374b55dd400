#include "drivers/recording/mcap_writer.h"

#include <algorithm>
#include <utility>

#include "drivers/recording/byte_writer.h"
#include "drivers/recording/crc32.h"
#include "drivers/recording/mcap_encoding.h"

namespace sparsight {

using mcap::Opcode;

McapWriter::McapWriter(std::unique_ptr<OutputFile> file, McapWriterOptions options)
    : file_(std::move(file)), options_(std::move(options)) {}

std::error_code McapWriter::start() {
  outline_.assign(mcap::kMagic.begin(), mcap::kMagic.end());
  append(mcap::Header{options_.profile, options_.library}, outline_);
  return put_whole(outline_);
}

std::uint16_t McapWriter::add_schema(std::string name, std::string encoding, std::string data) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, std::move(name), std::move(encoding), std::move(data)});
  flush();
  outline_.clear();
  append(schemas_.back(), outline_);
  put_whole(outline_);
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema_id, std::string topic,
                                      std::string message_encoding, mcap::TextMap metadata) {
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back(
      {id, schema_id, std::move(topic), std::move(message_encoding), std::move(metadata)});
  flush();
  outline_.clear();
  append(channels_.back(), outline_);
  put_whole(outline_);
  return id;
}

std::error_code McapWriter::add_attachment(const mcap::Attachment& attachment) {
  flush();
  outline_.clear();
  append(attachment, outline_);
  const mcap::AttachmentIndex index{end_,
                                    outline_.size(),
                                    attachment.log_time,
                                    attachment.create_time,
                                    attachment.data.size(),
                                    attachment.name,
                                    attachment.media_type};
  if (!put_whole(outline_)) attachments_.push_back(index);
  return failure_;
}

std::error_code McapWriter::add_metadata(const mcap::Metadata& metadata) {
  flush();
  outline_.clear();
  append(metadata, outline_);
  const mcap::MetadataIndex index{end_, outline_.size(), metadata.name};
  if (!put_whole(outline_)) metadata_.push_back(index);
  return failure_;
}

mcap::Buffer& McapWriter::begin_message(const mcap::Message& head) {
  message_start_ = records_.size();
  if (pending_messages_ == 0) chunk_start_time_ = chunk_end_time_ = head.log_time;
  chunk_start_time_ = std::min(chunk_start_time_, head.log_time);
  chunk_end_time_ = std::max(chunk_end_time_, head.log_time);
  entries_[head.channel_id].emplace_back(head.log_time, message_start_);
  ++pending_messages_;
  ++accepted_;
  ByteWriter writer(records_);
  writer.number(static_cast<std::uint8_t>(Opcode::kMessage));
  writer.number(std::uint64_t{0});
  append_message_head(head, records_);
  return records_;
}

std::error_code McapWriter::end_message() {
  const std::size_t size = records_.size() - message_start_;
  ByteWriter(records_).patch(message_start_ + 1, std::uint64_t{size - mcap::kPrefixBytes});
  largest_message_ = std::max(largest_message_, size);
  const auto duration =
      static_cast<std::uint64_t>(std::chrono::nanoseconds(options_.chunk_duration).count());
  // Written out before the next large message would burst it.
  const bool full = records_.size() + largest_message_ > options_.chunk_bytes;
  if (failure_ || full || chunk_end_time_ - chunk_start_time_ >= duration) return flush();
  return failure_;
}

std::error_code McapWriter::flush() {
  if (!failure_ && pending_messages_ > 0) failure_ = write_chunk();
  forget_chunk();
  return failure_;
}

void McapWriter::forget_chunk() {
  records_.clear();
  for (auto& [channel, entries] : entries_) entries.clear();
  pending_messages_ = 0;
}

std::error_code McapWriter::write_chunk() {
  Bytes packed(records_);
  if (options_.compression != Compression::kNone) {
    compress(options_.compression, records_, compressed_);
    packed = compressed_;
  }
  const std::uint32_t crc = crc32_of(records_);
  outline_.clear();
  mcap::append_chunk_head({chunk_start_time_, chunk_end_time_, records_.size(), crc,
                           std::string(mcap_name(options_.compression)), packed.size(), packed},
                          outline_);
  mcap::ChunkIndex index{chunk_start_time_, chunk_end_time_, end_};
  index.length = outline_.size() + packed.size();
  index.compression = mcap_name(options_.compression);
  index.compressed_size = packed.size();
  index.uncompressed_size = records_.size();

  mcap::Buffer message_indexes;
  for (const auto& [channel, entries] : entries_) {
    if (entries.empty()) continue;
    index.message_index_offsets[channel] = end_ + index.length + message_indexes.size();
    append(mcap::MessageIndex{channel, entries}, message_indexes);
  }
  index.message_index_length = message_indexes.size();

  std::error_code error = file_->write(outline_);
  if (!error) error = file_->write(packed);
  if (!error) error = file_->write(message_indexes);
  if (!error && options_.sync_chunks) error = file_->sync();
  if (error) {
    file_->truncate(end_);  // if that fails too, readers stop at the last whole chunk by themselves
    return error;
  }
  data_crc_ = crc32_of(outline_, data_crc_);
  const bool stored = options_.compression == Compression::kNone;
  data_crc_ = crc32_of_both(data_crc_, stored ? crc : crc32_of(packed), packed.size());
  data_crc_ = crc32_of(message_indexes, data_crc_);
  end_ += index.length + index.message_index_length;
  count_chunk(index);
  return {};
}

void McapWriter::count_chunk(const mcap::ChunkIndex& index) {
  const bool first = chunks_.empty();
  statistics_.start_time =
      first ? index.start_time : std::min(statistics_.start_time, index.start_time);
  statistics_.end_time = first ? index.end_time : std::max(statistics_.end_time, index.end_time);
  statistics_.message_count += pending_messages_;
  for (const auto& [channel, entries] : entries_) {
    if (!entries.empty()) statistics_.channel_message_counts[channel] += entries.size();
  }
  chunks_.push_back(index);
}

std::error_code McapWriter::put(Bytes bytes) {
  if (failure_) return failure_;
  failure_ = file_->write(bytes);
  if (failure_) {
    file_->truncate(end_);
    return failure_;
  }
  end_ += bytes.size();
  return {};
}

std::error_code McapWriter::put_whole(const mcap::Buffer& record) {
  if (put(record)) return failure_;
  data_crc_ = crc32_of(record, data_crc_);
  return {};
}

mcap::Buffer McapWriter::summary() const {
  mcap::Buffer out;
  std::vector<mcap::SummaryOffset> groups;
  const std::uint64_t start = end_ + mcap::kPrefixBytes + sizeof(mcap::DataEnd::data_section_crc);
  const auto append_group = [&](Opcode opcode, const auto& records) {
    const std::size_t before = out.size();
    for (const auto& record : records) append(record, out);
    if (out.size() > before) groups.push_back({opcode, start + before, out.size() - before});
  };
  mcap::Statistics statistics = statistics_;
  statistics.schema_count = static_cast<std::uint16_t>(schemas_.size());
  statistics.channel_count = static_cast<std::uint32_t>(channels_.size());
  statistics.attachment_count = static_cast<std::uint32_t>(attachments_.size());
  statistics.metadata_count = static_cast<std::uint32_t>(metadata_.size());
  statistics.chunk_count = static_cast<std::uint32_t>(chunks_.size());
  append_group(Opcode::kSchema, schemas_);
  append_group(Opcode::kChannel, channels_);
  append_group(Opcode::kStatistics, std::array{statistics});
  append_group(Opcode::kChunkIndex, chunks_);
  append_group(Opcode::kAttachmentIndex, attachments_);
  append_group(Opcode::kMetadataIndex, metadata_);
  const mcap::Footer footer{start, start + out.size()};
  for (const mcap::SummaryOffset& group : groups) append(group, out);
  append_footer(footer, out);
  return out;
}

std::error_code McapWriter::close() {
  if (closed_) return failure_;
  closed_ = true;
  flush();
  const std::error_code failure = std::exchange(failure_, {});
  const std::uint64_t data_end = end_;
  outline_.clear();
  append(mcap::DataEnd{data_crc_}, outline_);
  const mcap::Buffer index = summary();
  outline_.insert(outline_.end(), index.begin(), index.end());
  outline_.insert(outline_.end(), mcap::kMagic.begin(), mcap::kMagic.end());
  if (!put(outline_)) {
    failure_ = file_->sync();
  } else {
    end_ = data_end;
  }
  if (failure) failure_ = failure;
  return failure_;
}

}  // namespace sparsight
