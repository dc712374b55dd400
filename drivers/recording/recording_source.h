#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/recording/event_decoder.h"
#include "drivers/recording/mcap_reader.h"
#include "hal/result.h"
#include "hal/rig_event.h"

namespace sparsight {

// What a recording says of itself, known as soon as it is open.
struct RecordingInfo {
  std::string file;
  std::uint64_t bytes = 0;
  HostTime first;  // arrival of the first event; of the last whose chunk is whole
  HostTime last;
  std::map<std::string, std::uint64_t> messages;  // by topic
  std::vector<std::string> attachments;
  std::map<std::string, std::string> session;
  std::optional<std::chrono::nanoseconds> utc_offset;  // UTC minus host time
  bool indexed = false;
  bool truncated = false;  // cut off: the last second or so is not there

  std::chrono::nanoseconds duration() const { return last - first; }
};

struct RecordingFaults {
  McapFaults file;
  std::uint64_t refused_messages = 0;  // of our topics, with bytes that are not of their type
};

struct RecordingOptions {
  // The threads of a live rig hand their events over as they wake up, some milliseconds later or
  // earlier than each other: events are put back in the order of their arrival within this time.
  std::chrono::nanoseconds reorder_window{200'000'000};
};

// The raw events of a recording, whole or cut off, in the order of their arrival; those that
// arrived together in the order they were recorded. Thread-bound.
class RecordingSource final : public RigEventSource {
 public:
  static Result<std::unique_ptr<RecordingSource>> open(const std::filesystem::path& file,
                                                       const RecordingOptions& options = {});
  // The same on given bytes; `name` is for error messages.
  static Result<std::unique_ptr<RecordingSource>> open(std::unique_ptr<InputFile> file,
                                                       const std::string& name,
                                                       const RecordingOptions& options = {});

  std::optional<RigEvent> next() override;

  const RecordingInfo& info() const { return info_; }
  RecordingFaults faults() const { return {reader_->faults(), refused_messages_}; }
  // The first of that name: kRigConfigurationAttachment for the rig's configuration.
  Result<std::string> attachment(std::string_view name);

 private:
  RecordingSource(std::unique_ptr<McapReader> reader, std::string name,
                  const RecordingOptions& options);

  void describe(const std::string& name);
  bool read_more();
  void hold(RigEvent event);
  bool holds_enough() const;
  std::optional<RecordingTopic> topic_of(std::uint16_t channel_id);

  const std::unique_ptr<McapReader> reader_;
  const RecordingOptions options_;
  RecordingInfo info_;
  EventDecoder decoder_;
  std::map<std::uint16_t, std::optional<RecordingTopic>> topics_;  // by channel
  std::vector<RigEvent> decoded_;                                  // reused
  std::multimap<HostTime, RigEvent> held_;  // equal times stay in the order they came
  std::size_t held_bytes_ = 0;
  std::uint64_t refused_messages_ = 0;
};

}  // namespace sparsight
