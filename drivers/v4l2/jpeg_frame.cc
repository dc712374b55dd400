#include "drivers/v4l2/jpeg_frame.h"

#include <fmt/format.h>

#include <string_view>

namespace sparsight {
namespace {

// ITU-T T.81, table B.1.
constexpr std::uint8_t kStartOfImage = 0xD8;
constexpr std::uint8_t kEndOfImage = 0xD9;
constexpr std::uint8_t kStartOfScan = 0xDA;

bool is_restart(std::uint8_t marker) { return (marker & 0xF8U) == 0xD0; }
// SOF0..15 without DHT, JPG and DAC, which lie among them.
bool is_start_of_frame(std::uint8_t marker) {
  return (marker & 0xF0U) == 0xC0 && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

class JpegMarkers {
 public:
  explicit JpegMarkers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::optional<JpegExtent> extent() {
    // No fill byte before the first marker: decoders tell a JPEG from other formats by its first
    // bytes, and what they take for another format reaches a parser that was never meant for it.
    if (bytes_.size() < 2 || bytes_[0] != 0xFF || bytes_[1] != kStartOfImage) return std::nullopt;
    at_ = 2;
    while (const auto marker = next_marker()) {
      if (*marker == kEndOfImage) {
        extent_.bytes = at_;
        return scanned_ ? std::optional(extent_) : std::nullopt;
      }
      if (!pass_segment(*marker)) return std::nullopt;
      if (*marker == kStartOfScan && !pass_scan()) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  std::size_t left() const { return bytes_.size() - at_; }

  // Any number of fill bytes may stand before a later marker (B.1.1.2).
  std::optional<std::uint8_t> next_marker() {
    if (left() < 2 || bytes_[at_] != 0xFF) return std::nullopt;
    while (at_ < bytes_.size() && bytes_[at_] == 0xFF) ++at_;
    if (at_ == bytes_.size() || bytes_[at_] == 0) return std::nullopt;
    return bytes_[at_++];
  }

  bool pass_segment(std::uint8_t marker) {
    if (left() < 2 || marker == kStartOfImage || is_restart(marker)) return false;
    const std::size_t length = bytes_[at_] * std::size_t{256} + bytes_[at_ + 1];
    if (length < 2 || length > left()) return false;
    const auto segment = bytes_.subspan(at_ + 2, length - 2);
    at_ += length;
    if (!is_start_of_frame(marker)) return true;
    // Sample precision, lines, samples a line, components (B.2.2).
    if (segment.size() < 6 || extent_.width != 0) return false;
    extent_.height = segment[1] * 256 + segment[2];
    extent_.width = segment[3] * 256 + segment[4];
    const bool grey_or_color = segment[5] == 1 || segment[5] == 3;
    return segment[0] == 8 && grey_or_color && extent_.width > 0 && extent_.height > 0;
  }

  // Entropy-coded data: 0xFF is followed by 0, or is a restart marker whose number goes round.
  bool pass_scan() {
    if (extent_.width == 0) return false;
    scanned_ = true;
    std::uint8_t restart = 0xD0;
    while (left() >= 2) {
      if (bytes_[at_] != 0xFF) {
        ++at_;
      } else if (bytes_[at_ + 1] == 0) {
        at_ += 2;
      } else if (is_restart(bytes_[at_ + 1])) {
        if (bytes_[at_ + 1] != restart) return false;
        restart = static_cast<std::uint8_t>(0xD0 | ((restart + 1U) & 7U));
        at_ += 2;
      } else {
        return true;
      }
    }
    return false;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  JpegExtent extent_;
  bool scanned_ = false;
};

}  // namespace

std::optional<JpegExtent> jpeg_extent(std::span<const std::uint8_t> bytes) {
  return JpegMarkers(bytes).extent();
}

Result<DecodedImage> decode_jpeg_frame(const CameraFrame& frame) {
  const auto extent = jpeg_extent(frame.bytes);
  if (!extent) {
    return fail(ErrorCode::kMalformed,
                fmt::format("camera frame {}: its JPEG is cut off or garbled; see cable and USB "
                            "bandwidth",
                            frame.sequence));
  }
  if (extent->width != frame.width || extent->height != frame.height) {
    return fail(
        ErrorCode::kWrongSize,
        fmt::format("camera frame {}: its JPEG is of {} x {} pixels, but {} x {} were "
                    "agreed with the camera",
                    frame.sequence, extent->width, extent->height, frame.width, frame.height));
  }
  const std::string_view bytes(reinterpret_cast<const char*>(frame.bytes.data()), extent->bytes);
  return decode_image(bytes, fmt::format("camera frame {}", frame.sequence));
}

}  // namespace sparsight
