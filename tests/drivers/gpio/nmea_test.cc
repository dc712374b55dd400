#include "drivers/gpio/nmea.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono;

TEST(Nmea, ChecksumIsThatOfAKnownSentence) {
  EXPECT_EQ(nmea_checksum("GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W"),
            "6A");
  EXPECT_EQ(nmea_checksum(""), "00") << "two digits always";
}

TEST(Nmea, SentenceNamesTheSecondWithStatusA) {
  const UtcSecond second = sys_days(year(2026) / 11 / 22) + hours(9) + minutes(5) + seconds(7);
  const std::string sentence = gprmc(second);
  EXPECT_TRUE(sentence.starts_with("$GPRMC,090507,A,")) << sentence;
  EXPECT_NE(sentence.find(",221126,"), std::string::npos) << sentence;
  EXPECT_TRUE(sentence.ends_with("\r\n"));
  const std::size_t star = sentence.find('*');
  EXPECT_EQ(sentence.substr(star + 1), nmea_checksum(sentence.substr(1, star - 1)) + "\r\n");
}

TEST(Nmea, MidnightAndNewYearRollOverTogether) {
  const UtcSecond last = sys_days(year(2099) / 12 / 31) + hours(23) + minutes(59) + seconds(59);
  EXPECT_NE(gprmc(last).find("235959"), std::string::npos);
  EXPECT_NE(gprmc(last).find(",311299,"), std::string::npos);
  EXPECT_NE(gprmc(last + seconds(1)).find("000000"), std::string::npos);
  EXPECT_NE(gprmc(last + seconds(1)).find(",010100,"), std::string::npos);
}

TEST(Nmea, SentenceFitsIntoItsTimeAndItsStandard) {
  const std::string sentence = gprmc(UtcSecond());
  EXPECT_LE(sentence.size(), 82U);  // NMEA 0183
}

}  // namespace
}  // namespace sparsight
