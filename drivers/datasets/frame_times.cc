#include "drivers/datasets/frame_times.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "drivers/datasets/text_lines.h"

namespace sparsight {
namespace {

// So that the difference of any two fits the 64 bits of a HostTime (292 years).
constexpr double kMaxSeconds = 4.5e9;
constexpr int kMinYear = 1970;
constexpr int kMaxYear = 2200;

tl::unexpected<Error> malformed(const std::string& file, std::size_t line, std::string_view text,
                                std::string_view expected) {
  return fail(ErrorCode::kMalformed,
              fmt::format("{}:{}: \"{}\" is not {}", file, line, text.substr(0, 60), expected));
}

// The digits after the decimal point as nanoseconds; further digits are cut off.
std::optional<std::chrono::nanoseconds> fraction_from(std::string_view digits) {
  std::int64_t nanoseconds = 0;
  for (std::size_t i = 0; i < std::max<std::size_t>(digits.size(), 9); ++i) {
    const char digit = i < digits.size() ? digits[i] : '0';
    if (digit < '0' || digit > '9') return std::nullopt;
    if (i < 9) nanoseconds = 10 * nanoseconds + (digit - '0');
  }
  return std::chrono::nanoseconds(nanoseconds);
}

// A whole number of exactly `count` digits at `begin`.
std::optional<int> digits_at(std::string_view text, std::size_t begin, std::size_t count) {
  if (text.size() < begin + count || text[begin] == '-') return std::nullopt;
  return number_from<int>(text.substr(begin, count));
}

std::optional<HostTime> timestamp_from(std::string_view text) {
  const auto year = digits_at(text, 0, 4);
  const auto month = digits_at(text, 5, 2);
  const auto day = digits_at(text, 8, 2);
  const auto hour = digits_at(text, 11, 2);
  const auto minute = digits_at(text, 14, 2);
  const auto second = digits_at(text, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
  if (text[4] != '-' || text[7] != '-' || text[10] != ' ' || text[13] != ':' || text[16] != ':') {
    return std::nullopt;
  }
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day))};
  // 60 is a leap second.
  if (!date.ok() || *year < kMinYear || *year > kMaxYear || *hour > 23 || *minute > 59 ||
      *second > 60) {
    return std::nullopt;
  }
  std::chrono::nanoseconds since_1970 = std::chrono::sys_days(date).time_since_epoch();
  since_1970 +=
      std::chrono::hours(*hour) + std::chrono::minutes(*minute) + std::chrono::seconds(*second);
  if (text.size() > 19) {
    const auto fraction = text[19] == '.' ? fraction_from(text.substr(20)) : std::nullopt;
    if (!fraction) return std::nullopt;
    since_1970 += *fraction;
  }
  return HostTime(since_1970);
}

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t") - begin + 1);
}

}  // namespace

Result<std::vector<HostTime>> parse_times_seconds(std::string_view text, const std::string& file,
                                                  std::size_t lines_above) {
  std::vector<HostTime> times;
  std::vector<std::string_view> lines = split_lines(text);
  while (!lines.empty() && trimmed(lines.back()).empty()) lines.pop_back();
  for (const std::string_view line : lines) {
    const std::optional<double> seconds = number_from<double>(trimmed(line));
    if (!seconds || !(std::abs(*seconds) < kMaxSeconds)) {
      return malformed(file, lines_above + times.size() + 1, line, "a time in seconds");
    }
    times.emplace_back(std::chrono::nanoseconds(std::llround(*seconds * 1e9)));
  }
  return times;
}

Result<std::vector<std::optional<HostTime>>> parse_timestamps_utc(std::string_view text,
                                                                  const std::string& file) {
  std::vector<std::optional<HostTime>> times;
  for (const std::string_view line : split_lines(text)) {
    times.push_back(timestamp_from(trimmed(line)));
    if (!times.back() && !trimmed(line).empty()) {
      return malformed(file, times.size(), line, "a time like 2011-09-26 13:02:25.594360375");
    }
  }
  while (!times.empty() && !times.back()) times.pop_back();
  return times;
}

Result<std::vector<HostTime>> require_increasing(std::vector<HostTime> times,
                                                 const std::string& file, std::size_t lines_above) {
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}:{}: time {:.9f} s does not come after line {}'s {:.9f} s; frames "
                            "must be in the order of their exposure",
                            file, lines_above + i + 1, to_seconds(times[i].time_since_epoch()),
                            lines_above + i, to_seconds(times[i - 1].time_since_epoch())));
  }
  return times;
}

}  // namespace sparsight
