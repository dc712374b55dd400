#include "tools/evaluation/number_lines.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace sparsight {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kNanosecondDigits = 9;
constexpr std::size_t kQuotedFieldSize = 40;  // a broken file's field may be megabytes

std::vector<std::string_view> split_fields(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return fields;
}

std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

// Of a number without exponent, exactly: a double loses 0.2 us at today's date.
std::chrono::nanoseconds decimal_seconds(std::string_view text) {
  const bool negative = text.front() == '-';
  text.remove_prefix(negative ? 1 : 0);
  const std::size_t point = std::min(text.find('.'), text.size());
  std::int64_t nanoseconds = 0;  // stays 0 for ".5"
  std::from_chars(text.data(), text.data() + point, nanoseconds);
  const std::string_view fraction = text.substr(std::min(point + 1, text.size()));
  for (std::size_t i = 0; i < kNanosecondDigits; ++i) {
    nanoseconds = 10 * nanoseconds + (i < fraction.size() ? fraction[i] - '0' : 0);
  }
  const bool round_up = fraction.size() > kNanosecondDigits && fraction[kNanosecondDigits] >= '5';
  nanoseconds += round_up ? 1 : 0;
  return std::chrono::nanoseconds(negative ? -nanoseconds : nanoseconds);
}

Result<double> parse_field(const NumberLine& line, std::size_t field, const std::string& source) {
  // from_chars, unlike printf, knows no plus. Its long double form, which would do for times, reads
  // beyond the end of the text in libstdc++ 12.
  const std::string_view text = without_plus(line.fields[field]);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size() && std::isfinite(value)) {
    return value;
  }
  return fail(
      ErrorCode::kMalformed,
      fmt::format("{}:{}: field {} ('{}') is not a finite number; fields are separated by "
                  "blanks, the decimal sign is a point",
                  source, line.number, field + 1, line.fields[field].substr(0, kQuotedFieldSize)));
}

}  // namespace

std::vector<NumberLine> split_number_lines(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  std::vector<NumberLine> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    auto fields = split_fields(text.substr(0, end));
    if (!fields.empty() && !fields.front().starts_with('#')) {
      lines.push_back({number, std::move(fields)});
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Result<double> parse_number(const NumberLine& line, std::size_t field, const std::string& source) {
  return parse_field(line, field, source);
}

Result<std::chrono::nanoseconds> parse_seconds(const NumberLine& line, std::size_t field,
                                               const std::string& source) {
  const Result<double> seconds = parse_field(line, field, source);
  if (!seconds) {
    return tl::unexpected(seconds.error());
  }
  constexpr double kLongestSeconds = 4.6e9;  // differences still fit 64 bits of nanoseconds
  if (std::abs(*seconds) > kLongestSeconds) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}:{}: field {}, the time, is {}; it must be in seconds, not in "
                            "milli- or nanoseconds",
                            source, line.number, field + 1, line.fields[field]));
  }
  const std::string_view text = without_plus(line.fields[field]);
  const bool exponent = text.find_first_of("eE") != std::string_view::npos;
  return exponent ? std::chrono::nanoseconds(std::llround(*seconds * 1e9)) : decimal_seconds(text);
}

}  // namespace sparsight
