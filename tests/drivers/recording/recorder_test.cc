#include "drivers/recording/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/recording/made_events.h"
#include "tests/drivers/recording/made_recording.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::agreeing;
using testing::all_events;
using ::testing::HasSubstr;
using testing::made_content;
using testing::made_events;
using testing::MadeDisk;
using testing::MadeOutput;
using testing::open_bytes;

std::unique_ptr<Recorder> recorder_on(MadeDisk& disk, const RecorderConfig& config = {}) {
  return *Recorder::start(std::make_unique<MadeOutput>(disk), "made.mcap", made_content(), config);
}

template <typename Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(1ms);
  return condition();
}

TEST(Recorder, WritesAllItIsGiven) {
  const testing::TemporaryFolder folder;
  const auto events = made_events(1500ms);
  auto recorder = *Recorder::create(folder.path() / "r.mcap", made_content());
  for (const RigEvent& event : events) EXPECT_TRUE(recorder->record(event));
  EXPECT_TRUE(recorder->record(RecordedPose{}));
  const RecorderReport report = recorder->finish();
  EXPECT_EQ(report.state, RecorderState::kFinished);
  EXPECT_EQ(report.events_accepted, events.size() + 1);
  EXPECT_FALSE(report.lost_anything_raw());
  EXPECT_EQ(report.queued_bytes, 0);
  EXPECT_EQ(report.bytes_written, std::filesystem::file_size(folder.path() / "r.mcap"));
  auto source = *RecordingSource::open(folder.path() / "r.mcap");
  EXPECT_TRUE(source->info().indexed);
  EXPECT_EQ(agreeing(all_events(*source), events), events.size());
  EXPECT_FALSE(recorder->record(events[0]));
  EXPECT_EQ(recorder->report().events_refused, 1);
}

TEST(Recorder, TakesEventsFromSeveralThreads) {
  MadeDisk disk;
  auto recorder = recorder_on(disk);
  std::vector<std::thread> threads;
  for (std::uint8_t line = 0; line < 4; ++line) {
    threads.emplace_back([&recorder, line] {
      for (int i = 0; i < 500; ++i) {
        LidarPacket packet{testing::host_ns(i * 1000)};
        packet.payload[0] = line;
        recorder->record(packet);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(recorder->finish().events_accepted, 2000);
  auto source = *open_bytes(disk.bytes);
  std::array<int, 4> counts{};
  while (const auto event = source->next()) ++counts[std::get<LidarPacket>(*event).payload[0]];
  EXPECT_THAT(counts, ::testing::Each(500));
}

TEST(Recorder, WritesOutWhatItHasWhenNothingMoreComes) {
  MadeDisk disk;
  RecorderConfig config;
  config.file.chunk_duration = 20ms;
  auto recorder = recorder_on(disk, config);
  const int syncs = disk.syncs;
  recorder->record(Edge{EdgeLine::kPps, true, testing::host_ns(5)});
  EXPECT_TRUE(comes_true([&] { return disk.syncs > syncs; }));
}

TEST(Recorder, OnAFullDiskEndsWithAReadableFile) {
  const auto events = made_events(2000ms);
  const auto size = testing::recorded(events).size();
  for (const double share : {0.01, 0.3, 0.61, 0.999}) {
    MadeDisk disk;
    disk.capacity = static_cast<std::uint64_t>(share * static_cast<double>(size));
    auto recorder =
        Recorder::start(std::make_unique<MadeOutput>(disk), "made.mcap", made_content());
    if (!recorder) {
      EXPECT_LT(share, 0.1);
      EXPECT_THAT(recorder.error().message, HasSubstr("made.mcap: cannot be written"));
      continue;
    }
    for (const RigEvent& event : events) (*recorder)->record(event);
    const RecorderReport report = (*recorder)->finish();
    EXPECT_EQ(report.state, RecorderState::kDiskFull);
    EXPECT_THAT(report.message, HasSubstr("free space or record to another disk"));
    auto source = *open_bytes(disk.bytes);
    const auto read = all_events(*source);
    EXPECT_EQ(agreeing(read, events), read.size());
    EXPECT_GT(static_cast<double>(read.size()), (share - 0.3) * static_cast<double>(events.size()));
  }
}

TEST(Recorder, CountsWhatAFullDiskTook) {
  const auto events = made_events(2000ms);
  MadeDisk disk;
  disk.capacity = testing::recorded(events).size() / 2;
  auto writer =
      *RecordingWriter::start(std::make_unique<MadeOutput>(disk), "made.mcap", made_content());
  std::uint64_t refused = 0;
  for (const RigEvent& event : events) refused += writer->write(event) ? 0 : 1;
  EXPECT_GT(refused, 0);
  EXPECT_FALSE(writer->close());
  const McapWriter& mcap = writer->mcap();
  auto source = *open_bytes(disk.bytes);
  EXPECT_TRUE(source->info().indexed);  // cutting the last chunk off made room for the index
  std::uint64_t messages = 0;
  for (const auto& [topic, count] : source->info().messages) messages += count;
  EXPECT_EQ(mcap.messages_written(), messages);
  EXPECT_GE(mcap.messages_lost(), refused);
}

TEST(Recorder, OnADiskThatGoesAwayKeepsWhatWasWritten) {
  const auto events = made_events(3000ms);
  MadeDisk disk;
  auto recorder = recorder_on(disk);
  std::size_t given = 0;
  while (given < events.size() / 2) recorder->record(events[given++]);
  ASSERT_TRUE(comes_true([&] { return recorder->report().queued_bytes == 0; }));
  disk.gone = true;
  while (given < events.size()) recorder->record(events[given++]);
  EXPECT_TRUE(comes_true([&] { return recorder->report().state == RecorderState::kDiskFailed; }));
  const RecorderReport report = recorder->finish();
  EXPECT_EQ(report.state, RecorderState::kDiskFailed);
  EXPECT_TRUE(report.lost_anything_raw());
  EXPECT_THAT(report.message, HasSubstr("check the disk"));
  auto source = *open_bytes(disk.bytes);
  const auto read = all_events(*source);
  EXPECT_GT(read.size(), events.size() / 4);
  EXPECT_EQ(agreeing(read, events), read.size());
}

TEST(Recorder, EndsCleanlyAtTheFreeSpaceFloor) {
  MadeDisk disk;
  RecorderConfig config;
  config.space_interval = 100ms;
  auto recorder = recorder_on(disk, config);
  const auto events = made_events(300ms);
  for (const RigEvent& event : events) recorder->record(event);
  ASSERT_TRUE(comes_true([&] { return recorder->report().queued_bytes == 0; }));
  disk.free = 1 << 20;
  EXPECT_TRUE(comes_true([&] { return recorder->report().state == RecorderState::kFloorReached; }));
  EXPECT_THAT(recorder->report().message, HasSubstr("1 MiB are free and 1024 are kept free"));
  EXPECT_FALSE(recorder->record(events[0]));
  EXPECT_FALSE(recorder->finish().lost_anything_raw());
  auto source = *open_bytes(disk.bytes);
  EXPECT_TRUE(source->info().indexed);
  EXPECT_EQ(all_events(*source).size(), events.size());
}

TEST(Recorder, DoesNotBeginBelowTheFloor) {
  MadeDisk disk;
  disk.free = 5;
  const auto recorder = Recorder::start(std::make_unique<MadeOutput>(disk), "r.mcap", {});
  ASSERT_FALSE(recorder);
  EXPECT_THAT(recorder.error().message, HasSubstr("r.mcap: 0 MiB are free"));
  EXPECT_TRUE(disk.bytes.empty());
}

TEST(Recorder, OnASlowDiskLosesNothingThatFitsItsQueue) {
  const auto events = made_events(1000ms);
  MadeDisk disk;
  auto recorder = recorder_on(disk);
  disk.stalled = true;
  for (const RigEvent& event : events) EXPECT_TRUE(recorder->record(event));
  EXPECT_GT(recorder->report().most_queued_bytes, 500'000);
  disk.stalled = false;
  EXPECT_FALSE(recorder->finish().lost_anything_raw());
  EXPECT_EQ(agreeing(all_events(**open_bytes(disk.bytes)), events), events.size());
}

TEST(Recorder, OnASlowDiskDropsPreviewsThenFramesThenTheRest) {
  const auto events = made_events(2000ms);
  MadeDisk disk;
  RecorderConfig config;
  config.queue_bytes = 1 << 20;  // of 2.3 MB that come
  auto recorder = recorder_on(disk, config);
  disk.stalled = true;
  RecorderReport at_first_preview;
  RecorderReport at_first_frame;
  for (const RigEvent& event : events) {
    recorder->record(event);
    recorder->record(RecordedPose{});
    const RecorderReport report = recorder->report();
    if (at_first_preview.preview_dropped == 0) at_first_preview = report;
    if (at_first_frame.frames_dropped == 0) at_first_frame = report;
    ASSERT_LE(report.queued_bytes, config.queue_bytes);
  }
  EXPECT_GT(at_first_preview.preview_dropped, 0);
  EXPECT_EQ(at_first_preview.frames_dropped + at_first_preview.packets_dropped, 0);
  EXPECT_GT(at_first_frame.frames_dropped, 0);
  EXPECT_EQ(at_first_frame.packets_dropped, 0);
  disk.stalled = false;
  const RecorderReport report = recorder->finish();
  EXPECT_EQ(report.state, RecorderState::kFinished);
  EXPECT_TRUE(report.lost_anything_raw());
  const auto read = all_events(**open_bytes(disk.bytes));
  EXPECT_EQ(read.size() + report.frames_dropped + report.packets_dropped, events.size());
}

}  // namespace
}  // namespace sparsight
