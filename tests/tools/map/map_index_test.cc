#include "tools/map/map_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "drivers/recording/crc32.h"
#include "tests/tools/map/made_map.h"

namespace sparsight {
namespace {

using testing::made_index;

TEST(MapIndex, ReadsBackAsItWasToTheLastDigit) {
  const MapIndex index = made_index();
  const auto again = parse_map_index(map_index_bytes(index), "map.index");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->vocabulary, 77U);
  EXPECT_EQ(again->sessions, index.sessions);
  ASSERT_EQ(again->files.size(), 2U);
  EXPECT_EQ(again->files[1].name, "keyframes-0002.bin");
  EXPECT_EQ(again->files[1].bytes, 7000U);
  ASSERT_EQ(again->known.keyframes.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    const KnownKeyframe& a = index.known.keyframes[i];
    const KnownKeyframe& b = again->known.keyframes[i];
    EXPECT_EQ(a.session, b.session);
    EXPECT_EQ(a.sequence, b.sequence);
    EXPECT_EQ(a.submap, b.submap);
    EXPECT_EQ(a.camera.fx, b.camera.fx);
    EXPECT_EQ(a.camera.k1, b.camera.k1);
    EXPECT_EQ(a.T_map_camera.matrix(), b.T_map_camera.matrix());
    EXPECT_EQ(a.T_odometry_camera.matrix(), b.T_odometry_camera.matrix());
    ASSERT_EQ(b.bag.size(), 2U);
    EXPECT_EQ(a.bag[1].word, b.bag[1].word);
    EXPECT_EQ(a.bag[1].weight, b.bag[1].weight);
    EXPECT_EQ(index.places[i].record.has_value(), again->places[i].record.has_value());
  }
  EXPECT_EQ(again->places[7].record->offset, 1800U);
  ASSERT_EQ(again->known.edges.size(), index.known.edges.size());
  EXPECT_EQ(again->known.edges[2].information, index.known.edges[2].information);
  EXPECT_EQ(again->known.edges[2].T_from_to.matrix(), index.known.edges[2].T_from_to.matrix());
  EXPECT_TRUE(again->known.edges.back().loop);
  EXPECT_EQ(map_index_bytes(*again), map_index_bytes(index));
}

TEST(MapIndex, OfNothingReadsBackToo) {
  EXPECT_TRUE(parse_map_index(map_index_bytes({}), "map.index"));
}

TEST(MapIndex, CutOffAnywhereIsAnErrorThatNamesTheFile) {
  const std::vector<std::uint8_t> bytes = map_index_bytes(made_index());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto read = parse_map_index(Bytes(bytes).first(size), "m/map.index");
    ASSERT_FALSE(read) << size;
    ASSERT_THAT(read.error().message, ::testing::StartsWith("m/map.index: "));
  }
}

TEST(MapIndex, ABitThatFlippedAnywhereIsNoticed) {
  const std::vector<std::uint8_t> bytes = map_index_bytes(made_index());
  for (std::size_t byte = 0; byte < bytes.size(); ++byte) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[byte] ^= static_cast<std::uint8_t>(1U << (byte % 8));
    ASSERT_FALSE(parse_map_index(damaged, "here")) << byte;
  }
}

TEST(MapIndex, AnotherVersionIsToldByItsNumber) {
  std::vector<std::uint8_t> bytes = map_index_bytes(made_index());
  bytes[8] = 9;
  EXPECT_THAT(parse_map_index(bytes, "here").error().message,
              ::testing::HasSubstr("version 9; this program reads version 1"));
}

struct Damage {
  const char* what;
  std::function<void(MapIndex&)> done;
};

// Checksums are right in all of them: what is written is what is wrong.
TEST(MapIndex, WhatContradictsItselfIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Damage damages[] = {
      {"a record beyond its file", [](MapIndex& m) { m.places[2].record->offset = 4101; }},
      {"a record that wraps around", [](MapIndex& m) { m.places[2].record->offset = ~0ULL - 10; }},
      {"a file that is not there", [](MapIndex& m) { m.places[2].file = 2; }},
      {"a way out of the folder", [](MapIndex& m) { m.files[0].name = "../../etc/passwd"; }},
      {"no name", [](MapIndex& m) { m.files[0].name.clear(); }},
      {"a hidden name", [](MapIndex& m) { m.files[0].name = ".."; }},
      {"a session that is not there", [](MapIndex& m) { m.known.keyframes[2].session = 2; }},
      {"a sub-map to come", [](MapIndex& m) { m.known.keyframes[2].submap = 5; }},
      {"a sub-map that was left", [](MapIndex& m) { m.known.keyframes[6].submap = 0; }},
      {"no rotation", [](MapIndex& m) { m.known.keyframes[2].T_map_camera.linear() *= 1.1; }},
      {"a reflection", [](MapIndex& m) { m.known.keyframes[2].T_map_camera.linear() *= -1.0; }},
      {"no number", [=](MapIndex& m) { m.known.keyframes[2].T_odometry_camera(0, 3) = nan; }},
      {"no focal length", [](MapIndex& m) { m.known.keyframes[2].camera.fx = 0.0; }},
      {"no image", [](MapIndex& m) { m.known.keyframes[2].camera.width = -4; }},
      {"words that do not ascend", [](MapIndex& m) { m.known.keyframes[2].bag[1].word = 0; }},
      {"a weight that is none", [](MapIndex& m) { m.known.keyframes[2].bag[0].weight = -1.0F; }},
      {"an edge to nowhere", [](MapIndex& m) { m.known.edges[2].to = 10; }},
      {"an edge to itself", [](MapIndex& m) { m.known.edges[2].to = m.known.edges[2].from; }},
      {"negative information", [](MapIndex& m) { m.known.edges[2].information(3, 3) = -1.0; }},
      {"information that is no number",
       [=](MapIndex& m) { m.known.edges[2].information(3, 3) = nan; }},
  };
  for (const Damage& damage : damages) {
    MapIndex index = made_index();
    damage.done(index);
    EXPECT_FALSE(parse_map_index(map_index_bytes(index), "here")) << damage.what;
  }
}

TEST(MapIndex, ListsLongerThanTheFileAreRefusedBeforeTheyAreAllocated) {
  const std::vector<std::uint8_t> whole = map_index_bytes(made_index());
  for (std::size_t at = 24; at + 4 <= whole.size(); ++at) {
    std::vector<std::uint8_t> hostile = whole;
    std::memset(hostile.data() + at, 0xff, 4);
    const std::uint32_t checksum = crc32_of(Bytes(hostile).subspan(24));
    std::memcpy(hostile.data() + 20, &checksum, 4);
    parse_map_index(hostile, "here");  // whatever it says, it is said at once
  }
}

}  // namespace
}  // namespace sparsight
