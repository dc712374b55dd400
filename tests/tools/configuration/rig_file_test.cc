#include "tools/configuration/rig_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tests/build_paths.h"
#include "tests/tools/configuration/field_counter.h"
#include "tools/configuration/rig_fields.h"

namespace sparsight {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

std::string rig_error(std::string_view toml) {
  const auto rig = parse_rig(toml, "my.toml");
  return rig ? "no error" : rig.error().message;
}

TEST(RigFile, TheShippedRigLoadsAndShowsEveryKey) {
  const auto rig = load_rig(testing::source_dir() / "config/rig/handheld.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->name, "handheld");
  EXPECT_EQ(rig->camera.exposure, std::chrono::microseconds(4000));
  EXPECT_EQ(rig->camera.controls.at(0).name, "Power Line Frequency");
  EXPECT_EQ(rig->lidar.return_mode, ReturnMode::kStrongest);
  EXPECT_EQ(rig->trigger.pps_line, 27U);

  std::ifstream file(testing::source_dir() / "config/rig/handheld.toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  RigConfig all = *rig;
  all.lidar.elevation_deg.emplace();
  all.lidar.vertical_offset_mm.emplace();
  all.trigger.pps_output_line = 1;
  std::istringstream lines(describe(all));
  for (std::string line; std::getline(lines, line);) {
    const std::string key = line.substr(0, line.find(" = "));
    if (key.size() < line.size() && key != "matrix") {
      EXPECT_THAT(text, AnyOf(HasSubstr("\n" + key + " = "), HasSubstr("\n# " + key + " = ")))
          << "is not in the example";
    }
  }
}

TEST(RigFile, TheShippedTransformPutsWhatIsAheadOfTheLidarAheadOfTheCamera) {
  const RigConfig rig = load_rig(testing::source_dir() / "config/rig/handheld.toml").value();
  const Eigen::Isometry3d& T_camera_lidar = rig.calibration.T_camera_lidar;
  const Eigen::Vector3d ahead = T_camera_lidar * Eigen::Vector3d(5, 0, 0);
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(0.0, -0.12, 4.95), 1e-12)) << ahead.transpose();
  const Eigen::Vector3d left = T_camera_lidar.linear() * Eigen::Vector3d(0, 1, 0);
  EXPECT_TRUE(left.isApprox(Eigen::Vector3d(-1, 0, 0), 1e-12)) << left.transpose();
}

TEST(RigFile, AnEmptyFileIsARigOfDefaultsWithoutCalibration) {
  const RigConfig rig = parse_rig("", "my.toml").value();
  EXPECT_EQ(describe(rig), describe(RigConfig{}));
  EXPECT_EQ(rig.calibration.camera.width, 0);
  EXPECT_FALSE(rig.camera.exposure);
}

TEST(RigFile, AMissingFileSaysSo) {
  EXPECT_THAT(load_rig("/nowhere/rig.toml").error().message,
              HasSubstr("/nowhere/rig.toml: cannot read"));
}

// Values that a file may hold.
double any_number(FieldRange range) {
  return range.min + (range.max - range.min) * *rc::gen::inRange(0, 1000001) * 1e-6;
}
int any_integer(int low, int high) { return *rc::gen::inRange(low, high + 1); }

template <typename Value, typename Make>
std::optional<Value> maybe(const Make& make) {
  return *rc::gen::arbitrary<bool>() ? std::optional<Value>(make()) : std::nullopt;
}

std::string any_words() { return *rc::gen::container<std::string>(rc::gen::inRange<char>(1, 127)); }

CameraConfig any_camera() {
  CameraConfig camera;
  camera.device = "/dev/" + any_words();
  camera.width = any_integer(16, 4000);
  camera.height = any_integer(16, 4000);
  camera.rate_hz = any_number({1, 120});
  camera.format = *rc::gen::element<std::string>("auto", "GREY", "YUYV", "MJPG", "Y10");
  camera.buffers = any_integer(2, 32);
  camera.exposure = maybe<std::chrono::microseconds>(
      [] { return std::chrono::microseconds(any_integer(1, 7000)); });
  camera.gain = maybe<std::int64_t>([] { return any_integer(-100, 100); });
  for (int i = any_integer(0, 3); i > 0; --i) {
    camera.controls.push_back({"x" + any_words(), any_integer(-1000000, 1000000)});
  }
  return camera;
}

RigCalibration any_calibration(const CameraConfig& camera) {
  RigCalibration rig;
  rig.camera = {.width = camera.width,
                .height = camera.height,
                .fx = any_number({100, 1000}),
                .fy = any_number({100, 1000}),
                .cx = any_number({0, 15}),
                .cy = any_number({0, 15}),
                .k1 = any_number({-1, 1}),
                .p2 = any_number({-1, 1})};
  const Eigen::Vector3d axis(any_number({-1, 1}), any_number({-1, 1}), 1.0);
  rig.T_camera_lidar.linear() =
      Eigen::AngleAxisd(any_number({-3, 3}), axis.normalized()).toRotationMatrix();
  rig.T_camera_lidar.translation() << any_number({-1, 1}), any_number({-1, 1}), 0.1 + 0.2;
  return rig;
}

LidarConfig any_lidar() {
  LidarConfig lidar;
  lidar.sensor_address = *rc::gen::element<std::string>("", "10.0.0.1", "192.168.1.201");
  lidar.data_port = static_cast<std::uint16_t>(any_integer(1, 30000));
  lidar.position_port = static_cast<std::uint16_t>(any_integer(30001, 65535));
  lidar.seam_azimuth_deg = any_number({0, 360});
  lidar.max_range_m = any_number({1, 200});
  lidar.rpm = maybe<int>([] { return 60 * any_integer(5, 20); });
  lidar.return_mode =
      maybe<ReturnMode>([] { return *rc::gen::element(ReturnMode::kLast, ReturnMode::kDual); });
  lidar.phase_lock_deg = maybe<double>([] { return any_number({0, 360}); });
  lidar.elevation_deg = maybe<std::array<double, 16>>([] {
    std::array<double, 16> elevation{};
    for (std::size_t i = 0; i < 16; ++i)
      elevation[i] = static_cast<double>(i) + any_number({0, 1}) / 2;
    return elevation;
  });
  lidar.vertical_offset_mm = maybe<std::array<double, 16>>([] {
    std::array<double, 16> offset{};
    for (double& value : offset) value = any_number({-20, 20});
    return offset;
  });
  return lidar;
}

TriggerConfig any_trigger() {
  TriggerConfig trigger;
  trigger.chip = "/dev/gpiochip" + std::to_string(any_integer(0, 9));
  trigger.exposure_line = static_cast<unsigned>(any_integer(0, 99));
  trigger.exposure_active = *rc::gen::arbitrary<bool>();
  trigger.active_low = *rc::gen::arbitrary<bool>();
  trigger.trigger_delay = std::chrono::microseconds(any_integer(0, 1000));
  trigger.pps_line = maybe<unsigned>([] { return static_cast<unsigned>(any_integer(100, 199)); });
  trigger.pps_output_line =
      maybe<unsigned>([] { return static_cast<unsigned>(any_integer(200, 299)); });
  trigger.nmea_device = any_words();
  return trigger;
}

TEST(RigFile, DescriptionGivesTheSameRigBack) {
  EXPECT_TRUE(rc::check([] {
    RigConfig rig;
    rig.name = "x" + any_words();
    rig.camera = any_camera();
    if (*rc::gen::arbitrary<bool>()) rig.calibration = any_calibration(rig.camera);
    rig.lidar = any_lidar();
    rig.trigger = any_trigger();
    const std::string toml = describe(rig);
    const auto again = parse_rig(toml, "described.toml");
    RC_ASSERT(again.has_value());
    RC_ASSERT(describe(*again) == toml);
    RC_ASSERT(again->name == rig.name);
    RC_ASSERT(again->calibration.T_camera_lidar.matrix() ==
              rig.calibration.T_camera_lidar.matrix());
    RC_ASSERT(again->calibration.camera.fx == rig.calibration.camera.fx);
    RC_ASSERT(again->camera.exposure == rig.camera.exposure);
    RC_ASSERT(again->camera.controls.size() == rig.camera.controls.size());
    RC_ASSERT(again->lidar.rpm == rig.lidar.rpm);
    RC_ASSERT(again->lidar.return_mode == rig.lidar.return_mode);
    RC_ASSERT(again->lidar.elevation_deg == rig.lidar.elevation_deg);
    RC_ASSERT(again->trigger.pps_line == rig.trigger.pps_line);
    RC_ASSERT(again->trigger.nmea_device == rig.trigger.nmea_device);
  }));
}

TEST(RigFile, DescriptionSaysWhichFrameIsTakenToWhich) {
  EXPECT_THAT(describe(RigConfig{}), HasSubstr("# p_camera = T_camera_lidar * p_lidar, metres"));
}

TEST(RigFile, ErrorsNameFileLineFieldValueAndRangeAllAtOnce) {
  EXPECT_EQ(
      rig_error("[camera]\nwidth = 8\n\n[lidar]\ndata_port = 70000\nreturn_mode = \"both\"\n"),
      "my.toml:2: [camera] width = 8: must be between 16 and 16384\n"
      "my.toml:5: [lidar] data_port = 70000: must be between 1 and 65535\n"
      "my.toml:6: [lidar] return_mode = 'both': must be one of \"strongest\", \"last\", "
      "\"dual\"");
}

TEST(RigFile, UnknownKeysNameTheNearest) {
  EXPECT_EQ(rig_error("[trigger]\npps_lin = 3\n"),
            "my.toml:2: [trigger] pps_lin: unknown key; the nearest is pps_line");
  EXPECT_EQ(rig_error("[[camera.controls]]\nname = \"Gain\"\nvalue = 1\nvalu = 2\n"),
            "my.toml:4: [camera.controls] valu: unknown key; the nearest is value");
}

TEST(RigFile, TextsAreChecked) {
  EXPECT_EQ(rig_error("[lidar]\nsensor_address = \"velodyne\"\n"),
            "my.toml:2: [lidar] sensor_address = 'velodyne': must be an IPv4 address such as "
            "192.168.1.201, or \"\" for any");
  EXPECT_EQ(rig_error("[lidar]\nbind_address = \"\"\n"),
            "my.toml:2: [lidar] bind_address = '': must be an IPv4 address such as 192.168.1.201");
  EXPECT_THAT(rig_error("[camera]\nformat = \"H264\"\n"),
              HasSubstr("must be one of \"auto\", \"GREY\""));
  EXPECT_EQ(rig_error("[camera]\ndevice = 0\n"),
            "my.toml:2: [camera] device = 0: must be a text in quotes");
  EXPECT_EQ(rig_error("name = \"\"\n"), "my.toml:1: name = '': must not be empty");
}

TEST(RigFile, AnAddressWithAHiddenEndIsRefused) {
  EXPECT_THAT(rig_error("[lidar]\nbind_address = \"10.0.0.1\\u0000x\"\n"), HasSubstr("IPv4"));
}

TEST(RigFile, ControlsKeepTheirOrderAndNeedNameAndValue) {
  const auto rig = parse_rig(
      "[[camera.controls]]\nname = \"0x009a0901\"\nvalue = 1\n"
      "[[camera.controls]]\nname = \"Gamma\"\nvalue = -2\n",
      "my.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  ASSERT_EQ(rig->camera.controls.size(), 2U);
  EXPECT_EQ(rig->camera.controls[0].name, "0x009a0901");
  EXPECT_EQ(rig->camera.controls[1].value, -2);
  EXPECT_EQ(rig_error("[[camera.controls]]\nname = \"Gamma\"\n"),
            "my.toml:1: [camera.controls] value: missing");
  EXPECT_EQ(rig_error("[camera]\ncontrols = [3]\n"),
            "my.toml:2: [camera] controls = 3: must be a table, [[camera.controls]]");
  EXPECT_THAT(rig_error("[camera]\ncontrols = 3\n"), HasSubstr("must be a list of tables"));
}

TEST(RigFile, ListsOfNumbersHaveTheirSize) {
  EXPECT_EQ(rig_error("[lidar]\nelevation_deg = [1, 2]\n"),
            "my.toml:2: [lidar] elevation_deg = [1, 2]: must have 16, has 2");
  EXPECT_EQ(rig_error("[lidar]\nvertical_offset_mm = [\n1,2,3,4,5,6,7,8,\n9,10,11,12,13,14,15,\n"
                      "\"16\"]\n"),
            "my.toml:5: [lidar] vertical_offset_mm = '16': must be a number");
  EXPECT_THAT(rig_error("[lidar]\nelevation_deg = "
                        "[15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0]\n"),
              HasSubstr("must rise from the lowest laser to the highest"));
}

TEST(RigFile, FieldsThatDoNotGoTogetherAreRefused) {
  EXPECT_EQ(rig_error("[camera]\nrate_hz = 50\nexposure_us = 19000\n"),
            "my.toml:3: [camera] exposure_us = 19000: must be below 0.95 of the frame period, "
            "19000 us at 50 Hz");
  EXPECT_EQ(rig_error("[camera]\nrate_hz = 50\nexposure_us = 18999\n"), "no error");
  EXPECT_THAT(rig_error("[lidar]\nrpm = 630\n"), HasSubstr("must be a multiple of 60"));
  EXPECT_THAT(rig_error("[lidar]\nmin_range_m = 100\n"),
              HasSubstr("my.toml:1: [lidar] max_range_m: must be above min_range_m"));
  EXPECT_THAT(rig_error("[lidar]\nposition_port = 2368\n"),
              HasSubstr("must differ from data_port"));
  EXPECT_THAT(rig_error("[trigger]\nexposure_line = 4\npps_line = 4\n"),
              HasSubstr("my.toml:3: [trigger] pps_line = 4: is exposure_line already"));
  EXPECT_THAT(rig_error("[trigger]\npps_line = 4\npps_output_line = 4\n"),
              HasSubstr("my.toml:3: [trigger] pps_output_line = 4: is an input already"));
}

constexpr const char* kCalibratedCamera =
    "[calibration.camera]\nwidth = 800\nheight = 600\nfx = 460\nfy = 460\ncx = 400\ncy = 300\n";
constexpr const char* kLooksAhead =
    "[calibration.T_camera_lidar]\ntranslation_m = [0, 0, 0]\n"
    "quaternion_wxyz = [0.5, 0.5, -0.5, 0.5]\n";

TEST(RigFile, ACalibrationIsWholeOrAbsent) {
  EXPECT_EQ(rig_error(std::string(kCalibratedCamera) + kLooksAhead), "no error");
  EXPECT_THAT(rig_error(kCalibratedCamera), HasSubstr("[calibration] T_camera_lidar: missing"));
  EXPECT_EQ(rig_error(std::string("[calibration.camera]\nwidth = 800\nheight = 600\nfx = 460\n"
                                  "cx = 400\ncy = 300\n") +
                      kLooksAhead),
            "my.toml:1: [calibration.camera] fy: missing");
}

TEST(RigFile, ACalibrationForAnotherImageSizeIsRefused) {
  EXPECT_THAT(rig_error("camera.width = 640\n" + std::string(kCalibratedCamera) + kLooksAhead),
              HasSubstr("[calibration.camera] is for 800x600, [camera] streams 640x600"));
}

TEST(RigFile, AQuaternionMustHaveTheLengthOne) {
  const std::string start = "[calibration.T_camera_lidar]\ntranslation_m = [0, 0, 0]\n";
  EXPECT_EQ(rig_error(start + "quaternion_wxyz = [0.5, 0.5, 0.5, 0.6]\n"),
            "my.toml:3: [calibration.T_camera_lidar] quaternion_wxyz = [0.5, 0.5, 0.5, 0.6]: "
            "must have the length 1; w comes first");
  EXPECT_EQ(rig_error(start + "quaternion_wxyz = [0.7071, 0, 0.7071, 0]\n"), "no error");
  EXPECT_THAT(rig_error(start), HasSubstr("give translation_m and quaternion_wxyz, or matrix"));
  EXPECT_THAT(rig_error(start + "quaternion_wxyz = [1,0,0,0]\n"
                                "matrix = [[1,0,0,0],[0,1,0,0],[0,0,1,0]]\n"),
              HasSubstr("p_camera = T_camera_lidar * p_lidar"));
}

TEST(RigFile, AMatrixMustBeARotationAndATranslation) {
  const auto matrix = [](const std::string& first_row) {
    return "[calibration]\nT_camera_lidar.matrix = [" + first_row + ", [0,1,0,2], [0,0,1,3]]\n";
  };
  EXPECT_EQ(rig_error(matrix("[1,0,0,1]")), "no error");
  EXPECT_THAT(rig_error(matrix("[1.01,0,0,1]")), HasSubstr("must be a rotation"));
  EXPECT_THAT(rig_error(matrix("[-1,0,0,1]")), HasSubstr("determinant +1"));
  EXPECT_THAT(rig_error(matrix("[1,0,0]")), HasSubstr("must have 4, has 3"));
  EXPECT_THAT(rig_error(matrix("[nan,0,0,1]")), HasSubstr("must be between"));
}

TEST(RigFile, AMatrixOfFewDigitsBecomesTheNearestRotation) {
  const auto rig = parse_rig(
      "[calibration]\nT_camera_lidar.matrix = [[0.7071, -0.7071, 0, 1], [0.7071, 0.7071, 0, 2],"
      " [0, 0, 1, 3]]\n",
      "my.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  const Eigen::Matrix3d R = rig->calibration.T_camera_lidar.linear();
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-14));
  EXPECT_NEAR(R(0, 0), std::sqrt(0.5), 1e-14);
  EXPECT_EQ(rig->calibration.T_camera_lidar.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(RigFile, NoFieldOfTheStructsIsForgotten) {
  RigConfig rig;
  testing::FieldCounter fields;
  visit_fields(fields, rig);
  EXPECT_EQ(fields.count, testing::member_count<RigConfig>());
}

}  // namespace
}  // namespace sparsight
