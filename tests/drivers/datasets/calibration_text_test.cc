#include "drivers/datasets/calibration_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sparsight {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

CalibrationText parsed(std::string_view text) { return *CalibrationText::parse(text, "calib.txt"); }

TEST(CalibrationText, ReadsNumbersInAnyNotationAndLineEnding) {
  const auto text = parsed("a: 1 -2.5 3.0e+02\r\n\nb:4\n  \nc: 5e-1");
  EXPECT_THAT(*text.numbers("a", 3), ElementsAre(1, -2.5, 300));
  EXPECT_THAT(*text.numbers("b", 1), ElementsAre(4));
  EXPECT_THAT(*text.numbers("c", 1), ElementsAre(0.5));
}

TEST(CalibrationText, IgnoresFieldsNobodyAsksFor) {
  EXPECT_TRUE(parsed("calib_time: 09-Jan-2012 13:57:47\na: 1\n").numbers("a", 1));
}

TEST(CalibrationText, NamesLineFieldAndFaultOfEveryError) {
  const auto text = parsed("a: 1 2\nb: 1 two\nc: 1 nan\nd: 1 1e999\ne: 1 2x\n");
  const auto error = [&](const std::string& field) {
    return text.numbers(field, 2).error().message;
  };
  EXPECT_TRUE(text.numbers("a", 2));
  EXPECT_THAT(error("b"), AllOf(HasSubstr("calib.txt:2"), HasSubstr("field b"), HasSubstr("two")));
  EXPECT_THAT(error("c"), AllOf(HasSubstr("calib.txt:3"), HasSubstr("nan")));
  EXPECT_THAT(error("d"), AllOf(HasSubstr("calib.txt:4"), HasSubstr("1e999")));
  EXPECT_THAT(error("e"), AllOf(HasSubstr("calib.txt:5"), HasSubstr("2x")));
  EXPECT_THAT(error("f"), AllOf(HasSubstr("calib.txt"), HasSubstr("field f is missing")));
  EXPECT_THAT(text.numbers("a", 3).error().message, HasSubstr("2 numbers, expected 3"));
}

TEST(CalibrationText, RefusesLinesWithoutANameAndFieldsGivenTwice) {
  EXPECT_THAT(CalibrationText::parse("a: 1\n1 2 3\n", "f").error().message, HasSubstr("f:2"));
  EXPECT_THAT(CalibrationText::parse(": 1\n", "f").error().message, HasSubstr("f:1"));
  EXPECT_THAT(CalibrationText::parse("a: 1\nb: 1\na: 2\n", "f").error().message,
              AllOf(HasSubstr("f:3"), HasSubstr("line 1")));
}

TEST(CalibrationText, MakesPrintedRotationsExact) {
  const auto R = parsed("R: 0.866025 -0.5 0 0.5 0.866025 0 0 0 1\n").rotation("R");
  ASSERT_TRUE(R);
  EXPECT_TRUE((R->transpose() * *R).isApprox(Eigen::Matrix3d::Identity(), 1e-14));
  EXPECT_NEAR((*R)(1, 0), 0.5, 1e-6);
}

TEST(CalibrationText, RefusesReflectionsAndScales) {
  EXPECT_FALSE(parsed("R: 1 0 0 0 1 0 0 0 -1\n").rotation("R"));
  EXPECT_FALSE(parsed("R: 1.01 0 0 0 1.01 0 0 0 1.01\n").rotation("R"));
  EXPECT_FALSE(parsed("T: 0 0 0 1 0 0 0 2 0 0 0 3\n").transform("T"));
}

TEST(CalibrationText, SplitsAProjectionIntoCameraAndOffset) {
  const auto camera = rectified_camera(parsed("P: 700 0 600 -350 0 710 180 0 0 0 1 0\n"), "P");
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->intrinsics.fx, 700);
  EXPECT_EQ(camera->intrinsics.fy, 710);
  // The right camera of a stereo pair sees the reference camera half a metre to its left.
  EXPECT_TRUE(camera->T_camera_reference.translation().isApprox(Eigen::Vector3d(-0.5, 0, 0)));
}

TEST(CalibrationText, RefusesAProjectionThatIsNoPinhole) {
  EXPECT_FALSE(rectified_camera(parsed("P: 700 1 600 0 0 700 180 0 0 0 1 0\n"), "P"));
  EXPECT_FALSE(rectified_camera(parsed("P: 0 0 600 0 0 700 180 0 0 0 1 0\n"), "P"));
  EXPECT_FALSE(rectified_camera(parsed("P: 700 0 600 0 0 700 180 0 0 0 2 0\n"), "P"));
}

}  // namespace
}  // namespace sparsight
