#include "tools/doctor/doctor_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace sparsight {
namespace {

using ::testing::HasSubstr;

const std::vector<Check> kMixed{
    {"camera", Verdict::kOk, "GREY 800x600", ""},
    {"disk speed", Verdict::kWarn, "20 MB/s", "record to another disk"},
    {"lidar", Verdict::kFail, "no packet on UDP port 2368",
     "is it powered and cabled, is this host in its subnet, is it told to send here, and does no "
     "firewall stand between the two?"}};

TEST(DoctorReport, SaysWhatWasFoundAndWhatToDo) {
  const std::string text = doctor_text(kMixed);
  EXPECT_THAT(text, HasSubstr("ok    camera      GREY 800x600\n"));
  EXPECT_THAT(text, HasSubstr("warn  disk speed  20 MB/s\n"
                              "                  -> record to another disk\n"));
  EXPECT_THAT(text, HasSubstr("The rig is not fit: 1 of 3 checks failed.\n"));
}

TEST(DoctorReport, FitsIntoATerminal) {
  std::istringstream lines(doctor_text(kMixed));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
}

TEST(DoctorReport, WarningsDoNotMakeARigUnfit) {
  EXPECT_TRUE(is_fit({kMixed[0], kMixed[1]}));
  EXPECT_FALSE(is_fit(kMixed));
  EXPECT_THAT(doctor_text({kMixed[1]}), HasSubstr("fit, with 1 warning.\n"));
  EXPECT_THAT(doctor_text({kMixed[0]}), HasSubstr("The rig is fit.\n"));
}

TEST(DoctorReport, IsJsonForMachines) {
  const auto json = nlohmann::json::parse(doctor_json(kMixed));
  EXPECT_EQ(json.at("fit"), false);
  EXPECT_EQ(json.at("checks").size(), 3U);
  EXPECT_EQ(json.at("checks").at(1).at("verdict"), "warn");
  EXPECT_EQ(json.at("checks").at(2).at("name"), "lidar");
}

TEST(DoctorReport, AnyTextOfADriverBecomesJson) {
  EXPECT_TRUE(nlohmann::json::accept(doctor_json({{"camera", Verdict::kFail, "\xFF\"\n", ""}})));
}

}  // namespace
}  // namespace sparsight
