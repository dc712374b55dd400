#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"

namespace {

using namespace sparsight;

class NullOutput final : public OutputFile {
 public:
  std::error_code write(Bytes) override { return {}; }
  std::error_code sync() override { return {}; }
  std::error_code truncate(std::uint64_t) override { return {}; }
  std::optional<std::uint64_t> free_bytes() const override { return std::nullopt; }
};

// A message that was read lies within what was unpacked.
void read_messages(const std::vector<std::uint8_t>& bytes) {
  const auto reader = McapReader::open(input_from_memory(bytes), "fuzz");
  if (!reader) return;
  std::uint64_t sum = 0;
  while (const auto message = (*reader)->next()) {
    for (const std::uint8_t byte : message->data) sum += byte;
    if (!(*reader)->summary().channels.contains(message->channel_id)) std::abort();
  }
  (*reader)->seek(sum);
  (*reader)->next();
  for (const auto& index : (*reader)->summary().attachments) (*reader)->attachment(index);
}

}  // namespace

// Any bytes are read or refused; whatever event is read can be recorded again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::uint8_t> bytes(data, data + size);
  read_messages(bytes);
  auto source = RecordingSource::open(input_from_memory(bytes), "fuzz");
  if (!source) return 0;
  auto writer = RecordingWriter::start(std::make_unique<NullOutput>(), "again", {});
  while (const auto event = (*source)->next()) {
    if (!(*writer)->write(*event)) std::abort();
  }
  for (const std::string& name : (*source)->info().attachments) (*source)->attachment(name);
  if (!(*writer)->close()) std::abort();
  return 0;
}
