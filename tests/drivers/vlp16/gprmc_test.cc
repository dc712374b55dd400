#include "drivers/vlp16/gprmc.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <string>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// Checksums computed apart from the code.
constexpr auto kSentence = "$GPRMC,081802.00,A,3649.74,N,00224.45,W,0.0,212.5,210116,0.0,E*46";

TEST(Gprmc, ReadsTimeAndStatus) {
  const auto gprmc = parse_gprmc(kSentence);
  ASSERT_TRUE(gprmc);
  EXPECT_EQ(gprmc->time_of_day, 8h + 18min + 2s);
  EXPECT_TRUE(gprmc->receiver_valid);
}

TEST(Gprmc, ReadsFractionsLeapSecondsAndInvalidReceivers) {
  const auto gprmc = parse_gprmc("$GPRMC,235960.5,V,,,,,,,,,,*0D");
  ASSERT_TRUE(gprmc);
  EXPECT_EQ(gprmc->time_of_day, 24h + 500ms);
  EXPECT_FALSE(gprmc->receiver_valid);
}

TEST(Gprmc, ReadsTimesWithoutFraction) {
  const auto gprmc = parse_gprmc("$GPRMC,000000,A,,,,,,,010100,,*26");
  ASSERT_TRUE(gprmc);
  EXPECT_EQ(gprmc->time_of_day, 0s);
}

TEST(Gprmc, IgnoresWhatFollowsTheEnd) {
  EXPECT_TRUE(parse_gprmc(std::string(kSentence) + "\r\n$GPGGA,junk"));
  EXPECT_TRUE(parse_gprmc(std::string(kSentence) + std::string(200, '\0') + "junk"));
}

TEST(Gprmc, RefusesAWrongChecksum) {
  std::string sentence = kSentence;
  sentence.back() = '7';
  EXPECT_FALSE(parse_gprmc(sentence));
  EXPECT_FALSE(parse_gprmc("$GPRMC,000000,A,,,,,,,010100,,*-1"));
  EXPECT_FALSE(parse_gprmc("$GPRMC,000000,A,,,,,,,010100,,*2"));
  EXPECT_FALSE(parse_gprmc("$GPRMC,000000,A,,,,,,,010100,,"));
}

// With the checksum that each of them would need.
std::string with_checksum(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  constexpr auto kHex = "0123456789ABCDEF";
  return "$" + body + "*" + kHex[sum / 16 % 16] + kHex[sum % 16];
}

TEST(Gprmc, RefusesImpossibleContents) {
  EXPECT_TRUE(parse_gprmc(with_checksum("GPRMC,081802,A,,")));
  for (const char* const body :
       {"", "GPRMC", "GPRMC,", "GPGGA,081802,A,", "GPRMC,241802,A,", "GPRMC,086002,A,",
        "GPRMC,081861,A,", "GPRMC,08180,A,", "GPRMC,-81802,A,", "GPRMC,081802x,A,",
        "GPRMC,081802.x,A,", "GPRMC,081802.0000000000,A,", "GPRMC,081802,,", "GPRMC,081802,AA,",
        "GPRMC,081802,B,", "GPRMC,0818 2,A,"}) {
    EXPECT_FALSE(parse_gprmc(with_checksum(body))) << body;
  }
}

RC_GTEST_PROP(Gprmc, EveryCutSentenceIsRefused, ()) {
  const std::string sentence = kSentence;
  const auto length = *rc::gen::inRange<std::size_t>(0, sentence.size());
  RC_ASSERT(!parse_gprmc(sentence.substr(0, length)));
}

}  // namespace
}  // namespace sparsight
