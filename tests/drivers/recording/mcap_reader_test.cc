#include "drivers/recording/mcap_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "drivers/recording/byte_writer.h"
#include "drivers/recording/mcap_encoding.h"
#include "tests/drivers/recording/made_events.h"
#include "tests/drivers/recording/made_recording.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::all_events;
using testing::made_events;
using testing::open_bytes;
using testing::recorded;
using testing::same;
using Buffer = std::vector<std::uint8_t>;

McapSummary summary_of(const Buffer& bytes) {
  const auto file = input_from_memory(bytes);
  return read_summary(*file).value();
}

// Whether all of `part` stand in `whole`, in its order.
bool is_part(const std::vector<RigEvent>& part, const std::vector<RigEvent>& whole) {
  std::size_t at = 0;
  return std::ranges::all_of(part, [&](const RigEvent& event) {
    while (at < whole.size() && !same(whole[at], event)) ++at;
    return at < whole.size();
  });
}

TEST(McapReader, LeavesOutAChunkWhoseChecksumIsWrong) {
  const auto events = made_events(2500ms);
  for (const Compression compression :
       {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    McapWriterOptions options;
    options.compression = compression;
    Buffer bytes = recorded(events, options);
    const mcap::ChunkIndex chunk = summary_of(bytes).chunks[2];
    bytes[chunk.offset + chunk.length - 3000] ^= 0x10;
    auto source = *open_bytes(bytes);
    const auto read = all_events(*source);
    EXPECT_EQ(source->faults().file.damaged_chunks, 1);
    EXPECT_TRUE(is_part(read, events));
    EXPECT_NEAR(static_cast<double>(read.size()), 0.8 * static_cast<double>(events.size()), 60);
  }
}

TEST(McapReader, NeverAltersAnEventWhateverByteIsDamaged) {
  const auto events = made_events(1200ms, {.width = 10, .height = 10});
  const Buffer bytes = recorded(events, {.compression = Compression::kNone});
  ASSERT_EQ(summary_of(bytes).chunks.size(), 3);
  std::mt19937 random(5);
  const std::uint64_t start = summary_of(bytes).data_start;
  for (int i = 0; i < 150; ++i) {
    Buffer damaged = bytes;
    // As often among the short records around the chunks as in their bulk.
    const bool anywhere = i % 2 == 0;
    const mcap::ChunkIndex chunk = summary_of(bytes).chunks[1];
    const std::size_t at = anywhere ? start + random() % (bytes.size() - start)
                                    : chunk.offset + chunk.length - 10 + random() % 60;
    damaged[at] ^= static_cast<std::uint8_t>(1 + random() % 255);
    auto source = open_bytes(damaged);
    ASSERT_TRUE(source);
    const auto read = all_events(**source);
    ASSERT_TRUE(is_part(read, events)) << "byte " << at;
    ASSERT_GE(read.size(), events.size() * 5 / 10)
        << "byte " << at << ": more than a chunk is lost";
  }
}

TEST(McapReader, FindsTheNextChunkAfterARecordWithAWrongLength) {
  const auto events = made_events(2500ms);
  Buffer bytes = recorded(events);
  const auto chunks = summary_of(bytes).chunks;
  const std::size_t index_record = chunks[1].offset + chunks[1].length;
  ByteWriter(bytes).patch(index_record + 1, std::uint64_t{1} << 40);
  auto source = *open_bytes(bytes);
  EXPECT_EQ(all_events(*source).size(), events.size());
  EXPECT_EQ(source->faults().file.damaged_records, 1);
  ByteWriter(bytes).patch(index_record + 1, chunks[2].length);  // into the midst of the next
  EXPECT_EQ(all_events(**open_bytes(bytes)).size(), events.size());
}

TEST(McapReader, GoesToATime) {
  const auto events = made_events(3000ms);
  const auto reader = *McapReader::open(input_from_memory(recorded(events)), "made.mcap");
  const auto count_from = [&](std::uint64_t time) {
    reader->seek(time);
    std::uint64_t first = UINT64_MAX;
    std::uint64_t last = 0;
    while (const auto message = reader->next()) {
      first = std::min(first, message->log_time);
      last = std::max(last, message->log_time);
    }
    EXPECT_EQ(last, reader->summary().statistics.end_time);
    return first;
  };
  EXPECT_EQ(count_from(0), 1'000'000'000'000);
  EXPECT_LE(count_from(1'002'000'000'000), 1'002'000'000'000);
  EXPECT_GT(count_from(1'002'000'000'000), 1'001'400'000'000);
  reader->seek(1'004'000'000'000);
  EXPECT_FALSE(reader->next());
}

// A made file: magic, header, then what the test appends.
Buffer file_with(const Buffer& records) {
  Buffer bytes(mcap::kMagic.begin(), mcap::kMagic.end());
  append(mcap::Header{"ros2", "test"}, bytes);
  bytes.insert(bytes.end(), records.begin(), records.end());
  return bytes;
}

void append_message(const mcap::Message& message, Buffer& out) {
  const mcap::RecordScope record(out, mcap::Opcode::kMessage);
  append_message_head(message, out);
  ByteWriter(out).bytes(message.data);
}

TEST(McapReader, ReadsMessagesOutsideChunksAndPassesOverUnknownRecords) {
  Buffer records;
  append(mcap::Schema{1, "s", "ros2msg", "x"}, records);
  append(mcap::Channel{4, 1, "/t", "cdr", {}}, records);
  { const mcap::RecordScope unknown(records, static_cast<mcap::Opcode>(0x90)); }
  const Buffer data{1, 2, 3};
  append_message({4, 9, 10, 11, data}, records);
  append_message({5, 9, 10, 11, data}, records);  // of no channel
  const auto reader = *McapReader::open(input_from_memory(file_with(records)), "f");
  const auto message = reader->next();
  ASSERT_TRUE(message);
  EXPECT_EQ(message->sequence, 9);
  EXPECT_EQ(message->log_time, 10);
  EXPECT_EQ(message->publish_time, 11);
  EXPECT_TRUE(std::ranges::equal(message->data, data));
  EXPECT_FALSE(reader->next());
  EXPECT_EQ(reader->faults().unknown_channels, 1);
  EXPECT_FALSE(reader->summary().ended);
}

TEST(McapReader, RefusesChunksThatPromiseTooMuch) {
  const Buffer zeros(1 << 20);
  Buffer packed;
  compress(Compression::kZstd, zeros, packed);
  for (const std::uint64_t promised :
       {std::uint64_t{1} << 62, zeros.size() - 1, zeros.size() + 1}) {
    Buffer records;
    mcap::append_chunk_head({0, 0, promised, 0, "zstd", packed.size(), packed}, records);
    records.insert(records.end(), packed.begin(), packed.end());
    const auto reader = *McapReader::open(input_from_memory(file_with(records)), "f");
    EXPECT_FALSE(reader->next());
    EXPECT_EQ(reader->faults().damaged_chunks, 1) << promised;
  }
}

TEST(McapReader, BelievesNoIndexThatPointsAstray) {
  const auto events = made_events(600ms);
  Buffer bytes = recorded(events);
  const McapSummary summary = summary_of(bytes);
  // The same data under an index whose offsets are wild, with a checksum that fits.
  bytes.resize(summary.data_end);
  Buffer index;
  for (const auto& [id, schema] : summary.schemas) append(schema, index);
  for (const auto& [id, channel] : summary.channels) append(channel, index);
  append(mcap::ChunkIndex{.offset = UINT64_MAX - 3, .length = UINT64_MAX}, index);
  append(mcap::AttachmentIndex{.offset = summary.chunks[0].offset, .name = "rig.toml"}, index);
  append(mcap::MetadataIndex{.offset = UINT64_MAX, .name = kSessionMetadata}, index);
  mcap::append_footer({summary.data_end, 0}, index);
  bytes.insert(bytes.end(), index.begin(), index.end());
  bytes.insert(bytes.end(), mcap::kMagic.begin(), mcap::kMagic.end());
  auto source = *open_bytes(bytes);
  EXPECT_TRUE(source->info().indexed);
  EXPECT_EQ(all_events(*source).size(), events.size());
  EXPECT_EQ(source->attachment("rig.toml").error().code, ErrorCode::kMalformed);
}

// A disk that refuses a part of a file.
class HoledInput final : public InputFile {
 public:
  HoledInput(Buffer bytes, std::uint64_t hole) : file_(input_from_memory(bytes)), hole_(hole) {}
  std::uint64_t size() const override { return file_->size(); }
  bool read(std::uint64_t offset, std::span<std::uint8_t> out) override {
    if (offset <= hole_ && hole_ < offset + out.size()) return false;
    return file_->read(offset, out);
  }

 private:
  std::unique_ptr<InputFile> file_;
  std::uint64_t hole_;
};

TEST(McapReader, GoesOnAfterAPartThatTheDiskRefuses) {
  const auto events = made_events(2500ms);
  const Buffer bytes = recorded(events);
  const auto chunk = summary_of(bytes).chunks[1];
  auto source =
      *RecordingSource::open(std::make_unique<HoledInput>(bytes, chunk.offset + 5000), "holed");
  const auto read = all_events(*source);
  EXPECT_TRUE(is_part(read, events));
  EXPECT_NEAR(static_cast<double>(read.size()), 0.8 * static_cast<double>(events.size()), 60);
  EXPECT_EQ(source->faults().file.damaged_chunks, 1);
}

}  // namespace
}  // namespace sparsight
