#include "drivers/datasets/capture_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <utility>

#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/frame_times.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kNeeded =
    "a capture folder holds lidar.pcap, images/ (PNG or JPEG), times.txt and rig.toml";

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string_view leading_digits(std::string_view text) {
  return text.substr(0, std::min(text.find_first_not_of("0123456789"), text.size()));
}

// 9.png comes before 10.png, whether or not somebody padded them with zeros.
bool comes_before(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    std::string_view one = leading_digits(a);
    std::string_view other = leading_digits(b);
    if (one.empty() || other.empty()) {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    a.remove_prefix(one.size());
    b.remove_prefix(other.size());
    one.remove_prefix(std::min(one.find_first_not_of('0'), one.size()));
    other.remove_prefix(std::min(other.find_first_not_of('0'), other.size()));
    if (one.size() != other.size()) return one.size() < other.size();
    if (one != other) return one < other;
  }
  return a.size() < b.size();
}

std::vector<fs::path> files_of(const fs::path& folder,
                               std::initializer_list<std::string_view> extensions) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (std::ranges::find(extensions, extension_of(entry->path())) != extensions.end()) {
      files.push_back(entry->path());
    }
  }
  // Names that are alike but for zeros in front keep an order of their own.
  std::ranges::sort(files);
  std::ranges::stable_sort(files, [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().native(), b.filename().native());
  });
  return files;
}

std::vector<fs::path> captures_in(const fs::path& folder) {
  return files_of(folder, {".pcap", ".pcapng"});
}

Result<fs::path> the_capture_in(const fs::path& folder) {
  const std::vector<fs::path> captures = captures_in(folder);
  if (captures.size() == 1) return captures.front();
  const auto named = std::ranges::find(captures, "lidar", &fs::path::stem);
  if (named != captures.end()) return *named;
  if (captures.empty()) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no capture (*.pcap, *.pcapng) in it; {}",
                                                  folder.string(), kNeeded));
  }
  return fail(
      ErrorCode::kNotFound,
      fmt::format("{}: {} captures; name the LiDAR's lidar.pcap, or merge parts of one with "
                  "mergecap",
                  folder.string(), captures.size()));
}

struct TimesHeader {
  std::size_t lines = 0;
  std::size_t bytes = 0;
  CaptureClock clock = CaptureClock::kCapture;
};

Result<TimesHeader> header_of(std::string_view text, const std::string& file) {
  TimesHeader header;
  while (text.substr(header.bytes).starts_with('#')) {
    const std::size_t end = std::min(text.find('\n', header.bytes), text.size() - 1);
    const std::string_view line = text.substr(header.bytes, end + 1 - header.bytes);
    ++header.lines;
    header.bytes = end + 1;
    const std::size_t key = line.find("clock:");
    if (key == std::string_view::npos) continue;
    const std::string_view value = line.substr(key + 6);
    const bool lidar = value.find("lidar") != std::string_view::npos;
    if (lidar == (value.find("capture") != std::string_view::npos)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: clock must be \"capture\" (the machine that captured) or "
                              "\"lidar\" (the LiDAR's own, set by PPS)",
                              file, header.lines));
    }
    header.clock = lidar ? CaptureClock::kLidar : CaptureClock::kCapture;
  }
  return header;
}

Result<void> read_times(CaptureFolder& folder) {
  const std::string file = folder.times_file.string();
  const auto text = read_file_bytes(folder.times_file);
  if (!text) return fail(text.error().code, fmt::format("{}; {}", text.error().message, kNeeded));
  const auto header = header_of(*text, file);
  if (!header) return tl::unexpected(header.error());
  const std::string_view body = std::string_view(*text).substr(header->bytes);
  auto times = parse_times_seconds(body, file, header->lines);
  if (times) times = require_increasing(std::move(*times), file, header->lines);
  if (!times) return tl::unexpected(times.error());
  folder.exposures = std::move(*times);
  folder.clock = header->clock;
  return {};
}

}  // namespace

bool is_capture_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "images", error) ||
         fs::is_regular_file(folder / "rig.toml", error) || !captures_in(folder).empty();
}

Result<CaptureFolder> index_capture_folder(const fs::path& folder) {
  auto capture = the_capture_in(folder);
  if (!capture) return tl::unexpected(capture.error());
  CaptureFolder index{.capture = std::move(*capture),
                      .rig = folder / "rig.toml",
                      .times_file = folder / "times.txt"};
  const fs::path image_folder = folder / "images";
  index.images = files_of(image_folder, {".png", ".jpg", ".jpeg"});
  if (index.images.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no images (*.png, *.jpg); {}", image_folder.string(), kNeeded));
  }
  std::error_code error;
  if (!fs::is_regular_file(index.rig, error)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such file; {}. config/rig/handheld.toml shows how it looks",
                            index.rig.string(), kNeeded));
  }
  if (auto read = read_times(index); !read) return tl::unexpected(read.error());
  if (index.exposures.size() != index.images.size()) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: {} times, but {} holds {} images; every image needs its line, in "
                            "the order of the names",
                            index.times_file.string(), index.exposures.size(),
                            image_folder.string(), index.images.size()));
  }
  return index;
}

}  // namespace sparsight
