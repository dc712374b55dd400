#include "tools/cloud/las_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

// Byte by byte as ASPRS LAS 1.4 R15 has it. Another reader's word on it: tests/recording_reader/.
namespace sparsight {
namespace {

class LasFile : public ::testing::Test {
 protected:
  void write(const std::vector<MapPoint>& points, float full_intensity = 255.0F) {
    const auto path = std::filesystem::path(::testing::TempDir()) /
                      ::testing::UnitTest::GetInstance()->current_test_info()->name();
    const auto written = write_las(path, points, full_intensity);
    ASSERT_TRUE(written) << written.error().message;
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  template <typename T>
  T at(std::size_t offset) const {
    T value{};
    EXPECT_LE(offset + sizeof(T), bytes_.size());
    if (offset + sizeof(T) <= bytes_.size()) std::memcpy(&value, bytes_.data() + offset, sizeof(T));
    return value;
  }
  // Fixed width, the rest of it zeros.
  std::string text(std::size_t offset, std::size_t width) const {
    const std::string field = bytes_.substr(offset, width);
    const std::string shown = field.substr(0, field.find('\0'));
    EXPECT_EQ(field, shown + std::string(width - shown.size(), '\0'));
    return shown;
  }
  std::size_t first_point() const { return at<std::uint32_t>(96); }

  std::string bytes_;
};

const std::vector<MapPoint> kTwo = {
    {.p_world = {1.25F, -2.0F, 100.5F}, .intensity = 255.0F, .rgb = {255, 128, 0}},
    {.p_world = {-0.0014F, 0.5F, 98.0F}, .intensity = 51.0F, .rgb = {1, 2, 3}}};

TEST_F(LasFile, HeaderIsThatOfTable3) {
  write(kTwo);
  EXPECT_EQ(bytes_.substr(0, 4), "LASF");
  EXPECT_EQ(at<std::uint16_t>(4), 0);        // file source
  EXPECT_EQ(at<std::uint16_t>(6), 1U << 4);  // WKT, and nothing that is said of GPS time
  EXPECT_EQ(text(8, 16), "");                // project
  EXPECT_EQ(at<std::uint8_t>(24), 1);
  EXPECT_EQ(at<std::uint8_t>(25), 4);
  EXPECT_EQ(text(26, 32), "Sparsight");
  EXPECT_THAT(text(58, 32), ::testing::StartsWith("Sparsight 0."));
  EXPECT_EQ(at<std::uint16_t>(90), 0);  // day
  EXPECT_EQ(at<std::uint16_t>(92), 0);  // year
  EXPECT_EQ(at<std::uint16_t>(94), 375);
  EXPECT_EQ(at<std::uint32_t>(100), 1);  // VLRs
  EXPECT_EQ(at<std::uint8_t>(104), 7);
  EXPECT_EQ(at<std::uint16_t>(105), 36);
  EXPECT_EQ(at<std::uint32_t>(107), 0) << "what only older point formats have";
  for (int i = 0; i < 5; ++i) EXPECT_EQ(at<std::uint32_t>(111 + 4 * i), 0);
  EXPECT_EQ(at<std::uint64_t>(227), 0);  // waveforms
  EXPECT_EQ(at<std::uint64_t>(235), 0);  // EVLRs
  EXPECT_EQ(at<std::uint32_t>(243), 0);
  EXPECT_EQ(at<std::uint64_t>(247), 2);  // points
  EXPECT_EQ(at<std::uint64_t>(255), 2);  // first returns
  for (int i = 1; i < 15; ++i) EXPECT_EQ(at<std::uint64_t>(255 + 8 * i), 0);
}

TEST_F(LasFile, CoordinateSystemIsAWktRecord) {
  write(kTwo);
  EXPECT_EQ(at<std::uint16_t>(375), 0);
  EXPECT_EQ(text(377, 16), "LASF_Projection");
  EXPECT_EQ(at<std::uint16_t>(393), 2112);
  const auto length = at<std::uint16_t>(395);
  EXPECT_EQ(text(397, 32), "OGC WKT coordinate system");
  EXPECT_EQ(first_point(), 375U + 54U + length);
  const std::string wkt = text(429, length);
  EXPECT_EQ(wkt.size() + 1, length) << "one zero ends it";
  EXPECT_THAT(wkt, ::testing::StartsWith("LOCAL_CS[\""));
  EXPECT_EQ(std::count(wkt.begin(), wkt.end(), '['), std::count(wkt.begin(), wkt.end(), ']'));
}

TEST_F(LasFile, PointsAreThoseOfTables15And16) {
  write(kTwo);
  ASSERT_EQ(bytes_.size(), first_point() + 2 * 36);
  const std::size_t p = first_point();
  EXPECT_EQ(at<std::uint16_t>(p + 12), 65535);
  EXPECT_EQ(at<std::uint8_t>(p + 14), 0x11);  // return 1 of 1
  for (std::size_t i = 15; i < 30; ++i) EXPECT_EQ(bytes_[p + i], '\0') << i;
  EXPECT_EQ(at<std::uint16_t>(p + 30), 65535);
  EXPECT_EQ(at<std::uint16_t>(p + 32), 128 * 257);
  EXPECT_EQ(at<std::uint16_t>(p + 34), 0);
  EXPECT_EQ(at<std::uint16_t>(p + 36 + 12), 13107);  // a fifth
}

TEST_F(LasFile, PlacesAreMetresWithHeightUpToHalfAMillimetre) {
  write(kTwo);
  const Eigen::Vector3d expected[] = {{1.25, 100.5, 2.0}, {-0.0014, 98.0, -0.5}};
  Eigen::Vector3d lowest = Eigen::Vector3d::Constant(1e9);
  Eigen::Vector3d highest = -lowest;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place =
          at<std::int32_t>(first_point() + 36 * i + 4 * axis) * at<double>(131 + 8 * axis) +
          at<double>(155 + 8 * axis);
      EXPECT_NEAR(place, expected[i][static_cast<int>(axis)], 0.000501);
      lowest[static_cast<int>(axis)] = std::min(lowest[static_cast<int>(axis)], place);
      highest[static_cast<int>(axis)] = std::max(highest[static_cast<int>(axis)], place);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(at<double>(131 + 8 * axis), 0.001);
    EXPECT_EQ(at<double>(155 + 8 * axis), std::round(at<double>(155 + 8 * axis)));
    // Bounds are those of the points as they stand in the file, or validators complain.
    EXPECT_NEAR(at<double>(179 + 16 * axis), highest[axis], 1e-9);
    EXPECT_NEAR(at<double>(187 + 16 * axis), lowest[axis], 1e-9);
  }
}

TEST_F(LasFile, IntensityFillsTheRangeWhateverTheSensorsScale) {
  write({{.intensity = 0.5F}, {.intensity = 7.0F}, {.intensity = -1.0F}}, 1.0F);
  EXPECT_EQ(at<std::uint16_t>(first_point() + 12), 32768);
  EXPECT_EQ(at<std::uint16_t>(first_point() + 36 + 12), 65535);
  EXPECT_EQ(at<std::uint16_t>(first_point() + 72 + 12), 0);
}

TEST_F(LasFile, FarFromTheOriginAMillimetreIsStillAMillimetre) {
  write(
      {{.p_world = {900'000.0F, 0.0F, -900'000.0F}}, {.p_world = {900'001.0F, 3.0F, -899'990.0F}}});
  EXPECT_EQ(at<std::int32_t>(first_point() + 36) - at<std::int32_t>(first_point()), 1000);
  EXPECT_EQ(at<std::int32_t>(first_point() + 36 + 4) - at<std::int32_t>(first_point() + 4), 10'000);
}

TEST_F(LasFile, OfNoPointsIsWhole) {
  write({});
  EXPECT_EQ(bytes_.size(), first_point());
  EXPECT_EQ(at<std::uint64_t>(247), 0);
  EXPECT_EQ(at<double>(179), 0.0);
  EXPECT_EQ(at<double>(187), 0.0);
}

TEST(LasWriter, FolderThatIsNotThereIsAnErrorThatNamesTheFile) {
  const auto written = write_las("/nonexistent/map.las", {}, 255.0F);
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, ::testing::HasSubstr("/nonexistent/map.las"));
}

}  // namespace
}  // namespace sparsight
