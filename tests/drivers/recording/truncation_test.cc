#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "drivers/recording/mcap_summary.h"
#include "drivers/recording/recover.h"
#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/recording/made_events.h"
#include "tests/drivers/recording/made_recording.h"

// A power cut may come at any byte.
namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::agreeing;
using testing::all_events;
using testing::made_events;
using testing::open_bytes;
using testing::recorded;

// The arrival of the last event that was in the writer's hands when byte `size` was written: all
// of it is in the chunk that the cut fell into, or in the one before.
struct CutRecording {
  std::vector<RigEvent> events = made_events(2500ms);
  std::vector<std::uint8_t> bytes;
  McapSummary summary;

  explicit CutRecording(Compression compression) {
    McapWriterOptions options;
    options.compression = compression;
    bytes = recorded(events, options);
    const auto file = input_from_memory(bytes);
    summary = *read_summary(*file);
  }

  HostTime time_at(std::size_t size) const {
    HostTime time{};
    for (const mcap::ChunkIndex& chunk : summary.chunks) {
      if (chunk.offset < size) time = testing::host_ns(static_cast<std::int64_t>(chunk.end_time));
    }
    return time;
  }

  // Everything up to a second before the cut must be there, unaltered.
  void expect_little_lost(std::size_t size) const {
    auto source = open_bytes({bytes.begin(), bytes.begin() + static_cast<long>(size)});
    if (size < summary.data_start) return;
    ASSERT_TRUE(source) << size;
    const auto read = all_events(**source);
    const std::size_t kept = agreeing(read, events);
    ASSERT_EQ(kept, read.size()) << "an event was altered; cut at " << size;
    if (kept < events.size()) {
      ASSERT_GT(arrival_of(events[kept]), time_at(size) - 1s) << "cut at " << size;
    }
    EXPECT_EQ((*source)->info().truncated, size < summary.data_end) << size;
  }
};

class TruncationOfEachCompression : public ::testing::TestWithParam<Compression> {};

TEST_P(TruncationOfEachCompression, AtEveryChunkBoundaryLosesAtMostASecond) {
  const CutRecording recording(GetParam());
  ASSERT_GE(recording.summary.chunks.size(), 5);
  for (const mcap::ChunkIndex& chunk : recording.summary.chunks) {
    recording.expect_little_lost(chunk.offset);
    recording.expect_little_lost(chunk.offset + chunk.length);
    recording.expect_little_lost(chunk.offset + chunk.length - 1);
    recording.expect_little_lost(chunk.offset + chunk.length + chunk.message_index_length);
  }
}

TEST_P(TruncationOfEachCompression, AtAnyByteLosesAtMostASecond) {
  const CutRecording recording(GetParam());
  std::mt19937 random(11);
  for (int i = 0; i < 15; ++i) recording.expect_little_lost(random() % recording.bytes.size());
  for (std::size_t cut = 0; cut < 45; cut += 3) {
    recording.expect_little_lost(recording.bytes.size() - cut);
  }
}

INSTANTIATE_TEST_SUITE_P(, TruncationOfEachCompression,
                         ::testing::Values(Compression::kNone, Compression::kLz4,
                                           Compression::kZstd),
                         testing::compression_name);

TEST(Truncation, WithinAChunkStillGivesItsWholeMessages) {
  for (const Compression compression : {Compression::kNone, Compression::kZstd}) {
    const CutRecording recording(compression);
    const mcap::ChunkIndex& chunk = recording.summary.chunks[3];
    const auto boundary = static_cast<long>(chunk.offset);
    const auto within = static_cast<long>(chunk.offset + chunk.length - 2000);
    const auto begin = recording.bytes.begin();
    const auto before = all_events(**open_bytes({begin, begin + boundary})).size();
    const auto after = all_events(**open_bytes({begin, begin + within})).size();
    EXPECT_GT(after, before + 50);
  }
}

TEST(Truncation, IsToldWithWhatIsLeft) {
  const CutRecording recording(Compression::kLz4);
  const std::size_t size = recording.summary.chunks[3].offset;
  auto source =
      open_bytes({recording.bytes.begin(), recording.bytes.begin() + static_cast<long>(size)});
  const RecordingInfo& info = (*source)->info();
  EXPECT_FALSE(info.indexed);
  EXPECT_TRUE(info.truncated);
  EXPECT_NEAR(to_seconds(info.duration()), 1.5, 0.2);
  EXPECT_NEAR(static_cast<double>(info.messages.at("/velodyne_packets")), 1131, 150);
  EXPECT_EQ(*(*source)->attachment(kRigConfigurationAttachment), "name = \"made\"\n");
  EXPECT_EQ(info.utc_offset, testing::made_content().utc_offset);
}

TEST(Recovery, RestoresAnIndexedFileFromACutOne) {
  const testing::TemporaryFolder folder;
  const CutRecording recording(Compression::kLz4);
  const std::string whole(recording.bytes.begin(), recording.bytes.end());
  const std::size_t size = recording.summary.chunks[4].offset + 12345;
  testing::write_file(folder.path() / "cut.mcap", whole.substr(0, size));
  const auto report = recover_recording(folder.path() / "cut.mcap", folder.path() / "whole.mcap");
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_FALSE(report->was_whole);
  EXPECT_EQ(report->attachments, 1);
  EXPECT_EQ(report->bytes_read, size);
  EXPECT_EQ(report->bytes_written, std::filesystem::file_size(folder.path() / "whole.mcap"));

  auto cut = *RecordingSource::open(folder.path() / "cut.mcap");
  auto restored = *RecordingSource::open(folder.path() / "whole.mcap");
  EXPECT_TRUE(restored->info().indexed);
  EXPECT_FALSE(restored->info().truncated);
  EXPECT_EQ(restored->info().utc_offset, cut->info().utc_offset);
  EXPECT_EQ(*restored->attachment(kRigConfigurationAttachment), "name = \"made\"\n");
  const auto events = all_events(*cut);
  const auto restored_events = all_events(*restored);
  EXPECT_EQ(restored_events.size(), events.size());
  EXPECT_EQ(agreeing(restored_events, recording.events), events.size());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "whole.mcap.partial"));
}

TEST(Recovery, LeavesWhatExistsAlone) {
  const testing::TemporaryFolder folder;
  const auto bytes = recorded(made_events(100ms));
  const std::string whole(bytes.begin(), bytes.end());
  testing::write_file(folder.path() / "a.mcap", whole);
  EXPECT_FALSE(recover_recording(folder.path() / "a.mcap", folder.path() / "a.mcap"));
  EXPECT_EQ(testing::read_file(folder.path() / "a.mcap"), whole);
  EXPECT_TRUE(recover_recording(folder.path() / "a.mcap", folder.path() / "b.mcap")->was_whole);
  EXPECT_FALSE(recover_recording(folder.path() / "none.mcap", folder.path() / "c.mcap"));
  EXPECT_FALSE(recover_recording(folder.path() / "a.mcap", folder.path() / "no" / "c.mcap"));
}

}  // namespace
}  // namespace sparsight
