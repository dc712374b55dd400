#include "drivers/recording/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sparsight {
namespace {

constexpr std::chrono::milliseconds kPatience{50};

// Which share of the queue a kind may fill.
constexpr double kPreviewShare = 0.5;
constexpr double kFrameShare = 0.9;

const CameraFrame* frame_of(const std::variant<RigEvent, RecordedPose, RecordedSyncState>& entry) {
  const auto* event = std::get_if<RigEvent>(&entry);
  if (event == nullptr) return nullptr;
  const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(event);
  return frame == nullptr ? nullptr : frame->get();
}

template <typename Entry>
std::size_t bytes_of_entry(const Entry& entry) {
  const CameraFrame* frame = frame_of(entry);
  return sizeof(Entry) + (frame == nullptr ? 0 : sizeof(CameraFrame) + frame->bytes.size());
}

std::string too_little_space(std::uint64_t free, std::uint64_t floor) {
  return fmt::format("{} MiB are free and {} are kept free; free space or use another disk",
                     free >> 20, floor >> 20);
}

}  // namespace

Result<std::unique_ptr<Recorder>> Recorder::create(const std::filesystem::path& path,
                                                   const RecordingContent& content,
                                                   const RecorderConfig& config) {
  auto file = create_output_file(path, ExistingFile::kRefuse);
  if (!file) return tl::unexpected(file.error());
  auto recorder = start(std::move(*file), path.string(), content, config);
  std::error_code ignored;
  if (!recorder) std::filesystem::remove(path, ignored);
  return recorder;
}

Result<std::unique_ptr<Recorder>> Recorder::start(std::unique_ptr<OutputFile> file,
                                                  std::string name, const RecordingContent& content,
                                                  const RecorderConfig& config) {
  const std::optional<std::uint64_t> free = file->free_bytes();
  if (free && *free < config.free_space_floor_bytes) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("{}: {}", name, too_little_space(*free, config.free_space_floor_bytes)));
  }
  auto writer = RecordingWriter::start(std::move(file), std::move(name), content, config.file);
  if (!writer) return tl::unexpected(writer.error());
  return std::unique_ptr<Recorder>(new Recorder(std::move(*writer), config));
}

Recorder::Recorder(std::unique_ptr<RecordingWriter> writer, const RecorderConfig& config)
    : writer_(std::move(writer)), config_(config), thread_([this] { run(); }) {}

Recorder::~Recorder() { finish(); }

bool Recorder::record(RigEvent event) { return accept(std::move(event)); }
bool Recorder::record(const RecordedPose& pose) { return accept(pose); }
bool Recorder::record(const RecordedSyncState& state) { return accept(state); }

RecorderReport Recorder::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

RecorderReport Recorder::finish() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  return report();
}

bool Recorder::accept(Entry entry) {
  const std::size_t bytes = bytes_of_entry(entry);
  {
    const std::lock_guard lock(mutex_);
    if (stopping_ || report_.state != RecorderState::kRecording) {
      ++report_.events_refused;
      return false;
    }
    if (!has_room(entry, bytes)) return false;
    ++report_.events_accepted;
    report_.queued_bytes += bytes;
    report_.most_queued_bytes = std::max(report_.most_queued_bytes, report_.queued_bytes);
    queue_.push_back(std::move(entry));
  }
  changed_.notify_one();
  return true;
}

bool Recorder::has_room(const Entry& entry, std::size_t bytes) {
  const bool raw = std::holds_alternative<RigEvent>(entry);
  const bool frame = frame_of(entry) != nullptr;
  const double share = frame ? kFrameShare : raw ? 1.0 : kPreviewShare;
  const double filled = static_cast<double>(report_.queued_bytes + bytes);
  if (filled <= share * static_cast<double>(config_.queue_bytes)) return true;
  ++(frame ? report_.frames_dropped : raw ? report_.packets_dropped : report_.preview_dropped);
  return false;
}

// What is taken still counts as queued until it is written: it still fills memory.
std::optional<Recorder::Entry> Recorder::take() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kPatience, [this] { return !queue_.empty() || stopping_; });
  if (queue_.empty()) return std::nullopt;
  std::optional<Entry> entry(std::move(queue_.front()));
  queue_.pop_front();
  return entry;
}

void Recorder::run() {
  for (;;) {
    const std::optional<Entry> entry = take();
    if (entry) write(*entry);
    keep_pace();
    watch_space();
    const std::lock_guard lock(mutex_);
    if (report_.state != RecorderState::kRecording) return;
    if (stopping_ && queue_.empty()) break;
  }
  end(RecorderState::kFinished, "");
}

void Recorder::write(const Entry& entry) {
  const Clock::time_point start = Clock::now();
  const Result<void> written =
      std::visit([this](const auto& e) { return writer_->write(e); }, entry);
  const Clock::duration took = Clock::now() - start;
  {
    const std::lock_guard lock(mutex_);
    report_.queued_bytes -= bytes_of_entry(entry);
    report_.slowest_write = std::max<std::chrono::nanoseconds>(report_.slowest_write, took);
    report_.bytes_written = writer_->mcap().bytes_written();
  }
  if (!written) end(RecorderState::kDiskFailed, written.error().message);
}

// Chunks also end when nothing comes that would fill them.
void Recorder::keep_pace() {
  const std::uint64_t bytes = writer_->mcap().bytes_written();
  const Clock::time_point now = Clock::now();
  if (bytes != std::exchange(flushed_bytes_, bytes)) last_flush_ = now;
  if (now - last_flush_ < config_.file.chunk_duration) return;
  last_flush_ = now;
  const auto flushed = writer_->flush();
  if (!flushed) end(RecorderState::kDiskFailed, flushed.error().message);
}

void Recorder::watch_space() {
  const Clock::time_point now = Clock::now();
  if (now - last_look_ < config_.space_interval) return;
  last_look_ = now;
  const std::optional<std::uint64_t> free = writer_->mcap().file().free_bytes();
  {
    const std::lock_guard lock(mutex_);
    report_.free_bytes = free;
  }
  if (free && *free < config_.free_space_floor_bytes) {
    end(RecorderState::kFloorReached,
        "recording ended: " + too_little_space(*free, config_.free_space_floor_bytes));
  }
}

// Completes the file, whatever happened before; the first reason stands.
void Recorder::end(RecorderState state, std::string message) {
  const Result<void> closed = writer_->close();
  const std::lock_guard lock(mutex_);
  if (report_.state != RecorderState::kRecording) return;
  report_.state = state;
  report_.message = std::move(message);
  if (!closed) {
    const bool full = writer_->mcap().failure() == std::errc::no_space_on_device;
    report_.state = full ? RecorderState::kDiskFull : RecorderState::kDiskFailed;
    report_.message = closed.error().message;
  }
  report_.events_refused += queue_.size();
  report_.queued_bytes = 0;
  report_.bytes_written = writer_->mcap().bytes_written();
  report_.messages_lost = writer_->mcap().messages_lost();
  queue_.clear();
}

}  // namespace sparsight
