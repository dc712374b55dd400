#include "tools/map/keyframe_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "drivers/recording/crc32.h"
#include "tests/tools/map/made_keyframe.h"

namespace sparsight {
namespace {

using testing::made_cloud;
using testing::patchwork;

KeyframeBulk made_bulk() {
  return {.image = patchwork(40, 30, 1), .cloud_camera = made_cloud(50, 2)};
}

TEST(KeyframeRecord, ReadsBackAsItWas) {
  const KeyframeBulk bulk = made_bulk();
  const auto again = parse_keyframe_record(keyframe_record(bulk), "here");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->image.width, 40);
  EXPECT_EQ(again->image.pixels, bulk.image.pixels);
  ASSERT_EQ(again->cloud_camera.size(), 50U);
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_EQ(again->cloud_camera[i].p_camera, bulk.cloud_camera[i].p_camera);
    EXPECT_EQ(again->cloud_camera[i].intensity, bulk.cloud_camera[i].intensity);
    EXPECT_EQ(again->cloud_camera[i].rgb, bulk.cloud_camera[i].rgb);
    EXPECT_EQ(again->cloud_camera[i].colored, bulk.cloud_camera[i].colored);
  }
}

TEST(KeyframeRecord, OfNothingReadsBackToo) {
  const auto again = parse_keyframe_record(keyframe_record({}), "here");
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->image.empty());
  EXPECT_TRUE(again->cloud_camera.empty());
}

TEST(KeyframeRecord, StandsInTheFileAsItsHeaderSays) {
  const std::vector<std::uint8_t> record = keyframe_record(
      {.image = {2, 1, {7, 9}},
       .cloud_camera = {{.p_camera = {1, 2, 4}, .intensity = 0.5F, .rgb = {10, 20, 30}}}});
  const std::vector<std::uint8_t> payload = {2,    0,    0, 0, 1,    0,    0,  0,  7,  9,    1, 0,
                                             0,    0,    0, 0, 0x80, 0x3f, 0,  0,  0,  0x40, 0, 0,
                                             0x80, 0x40, 0, 0, 0,    0x3f, 10, 20, 30, 1};
  ASSERT_EQ(record.size(), 12 + payload.size());
  EXPECT_EQ(std::string(record.begin(), record.begin() + 4), "SKF1");
  EXPECT_EQ(record[4], payload.size());
  EXPECT_EQ(std::vector<std::uint8_t>(record.begin() + 12, record.end()), payload);
}

TEST(KeyframeRecord, ABitThatFlippedAnywhereIsNoticed) {
  const std::vector<std::uint8_t> record = keyframe_record(made_bulk());
  for (std::size_t byte = 0; byte < record.size(); byte += 7) {
    std::vector<std::uint8_t> damaged = record;
    damaged[byte] ^= static_cast<std::uint8_t>(1U << (byte % 8));
    const auto read = parse_keyframe_record(damaged, "map/keyframes-1.bin: at byte 64");
    ASSERT_FALSE(read) << byte;
    EXPECT_THAT(read.error().message, ::testing::StartsWith("map/keyframes-1.bin: at byte 64: "));
  }
}

TEST(KeyframeRecord, CutOffAnywhereIsAnError) {
  const std::vector<std::uint8_t> record = keyframe_record(made_bulk());
  for (std::size_t size = 0; size < record.size(); ++size) {
    ASSERT_FALSE(parse_keyframe_record(Bytes(record).first(size), "here")) << size;
  }
}

// A checksum vouches for what was written, not for who wrote it.
std::vector<std::uint8_t> sealed(std::vector<std::uint8_t> record) {
  const std::uint32_t checksum = crc32_of(Bytes(record).subspan(12));
  std::memcpy(record.data() + 8, &checksum, 4);
  return record;
}

TEST(KeyframeRecord, SizesBeyondTheRecordAreRefusedBeforeTheyAreAllocated) {
  const std::vector<std::uint8_t> record = keyframe_record(made_bulk());
  for (const std::size_t field : {std::size_t{12}, std::size_t{16}, 20 + 40 * std::size_t{30}}) {
    for (const std::uint32_t value : {41U, 0x7fffU, 0x8000U, 0xffffffffU}) {
      std::vector<std::uint8_t> hostile = record;
      std::memcpy(hostile.data() + field, &value, 4);
      EXPECT_FALSE(parse_keyframe_record(sealed(hostile), "here")) << field << " " << value;
    }
  }
}

TEST(KeyframeRecord, APointThatIsNotANumberIsRefused) {
  KeyframeBulk bulk = made_bulk();
  bulk.cloud_camera[3].p_camera.y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(parse_keyframe_record(keyframe_record(bulk), "here"));
}

}  // namespace
}  // namespace sparsight
