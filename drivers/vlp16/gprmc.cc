#include "drivers/vlp16/gprmc.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

// Exactly so many digits, nothing else.
std::optional<int> digits(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// The sentence between '$' and '*', if the checksum behind it is that of its characters.
std::optional<std::string_view> checked_body(std::string_view text) {
  text = text.substr(0, text.find_first_of(std::string_view("\0\r\n", 3)));
  if (text.empty() || text.front() != '$') return std::nullopt;
  text.remove_prefix(1);
  const std::size_t star = text.find('*');
  if (star == std::string_view::npos || text.size() != star + 3) return std::nullopt;
  unsigned announced = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data() + star + 1, end, announced, 16);
  if (parsed.ec != std::errc{} || parsed.ptr != end) return std::nullopt;
  unsigned sum = 0;
  for (const char c : text.substr(0, star)) sum ^= static_cast<std::uint8_t>(c);
  if (sum != announced) return std::nullopt;
  return text.substr(0, star);
}

std::string_view next_field(std::string_view& rest) {
  const std::size_t comma = rest.find(',');
  const std::string_view field = rest.substr(0, comma);
  rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  return field;
}

std::optional<nanoseconds> fraction_of_second(std::string_view text) {
  if (text.empty()) return nanoseconds{0};
  // "081802." is a time of some receivers.
  if (text.front() != '.' || text.size() > 10) return std::nullopt;
  if (text.size() == 1) return nanoseconds{0};
  const auto value = digits(text.substr(1));
  if (!value) return std::nullopt;
  std::int64_t count = *value;
  for (std::size_t places = text.size() - 1; places < 9; ++places) count *= 10;
  return nanoseconds(count);
}

std::optional<nanoseconds> time_of_day(std::string_view text) {
  if (text.size() < 6) return std::nullopt;
  const auto hours = digits(text.substr(0, 2));
  const auto minutes = digits(text.substr(2, 2));
  const auto seconds = digits(text.substr(4, 2));
  const auto fraction = fraction_of_second(text.substr(6));
  if (!hours || !minutes || !seconds || !fraction) return std::nullopt;
  if (*hours > 23 || *minutes > 59 || *seconds > 60) return std::nullopt;  // 60: a leap second
  return std::chrono::hours(*hours) + std::chrono::minutes(*minutes) +
         std::chrono::seconds(*seconds) + *fraction;
}

}  // namespace

std::optional<Gprmc> parse_gprmc(std::string_view text) {
  auto rest = checked_body(text);
  if (!rest || next_field(*rest) != "GPRMC") return std::nullopt;
  const auto time = time_of_day(next_field(*rest));
  const std::string_view status = next_field(*rest);
  if (!time || (status != "A" && status != "V")) return std::nullopt;
  return Gprmc{*time, status == "A"};
}

}  // namespace sparsight
