#include "drivers/gpio/nmea.h"

#include <fmt/format.h>

namespace sparsight {

std::string nmea_checksum(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return fmt::format("{:02X}", sum);
}

std::string gprmc(UtcSecond second) {
  using namespace std::chrono;
  const auto midnight = floor<days>(second);
  const year_month_day date(midnight);
  const hh_mm_ss time(second - midnight);
  const std::string body = fmt::format(
      "GPRMC,{:02}{:02}{:02},A,0000.0000,N,00000.0000,E,000.0,000.0,{:02}{:02}{:02},000.0,E",
      time.hours().count(), time.minutes().count(), time.seconds().count(),
      static_cast<unsigned>(date.day()), static_cast<unsigned>(date.month()),
      static_cast<int>(date.year()) % 100);
  return fmt::format("${}*{}\r\n", body, nmea_checksum(body));
}

}  // namespace sparsight
