#include "drivers/recording/chunk_compression.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>
#include <vector>

#include "drivers/recording/crc32.h"

namespace sparsight {
namespace {

using Buffer = std::vector<std::uint8_t>;
constexpr Compression kPacking[] = {Compression::kLz4, Compression::kZstd};

RC_GTEST_PROP(ChunkCompression, GivesBackAnyBytes, ()) {
  const auto bytes = *rc::gen::arbitrary<Buffer>();
  for (const Compression compression : kPacking) {
    Buffer packed;
    Buffer unpacked;
    compress(compression, bytes, packed);
    RC_ASSERT(decompress(compression, packed, bytes.size(), unpacked));
    RC_ASSERT(unpacked == bytes);
  }
}

TEST(ChunkCompression, OfTheFrontOfAChunkGivesItsFront) {
  Buffer bytes(3 << 20);
  std::mt19937 random(1);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 8);
  for (const Compression compression : kPacking) {
    Buffer packed;
    Buffer front;
    compress(compression, bytes, packed);
    EXPECT_FALSE(
        decompress(compression, Bytes(packed).first(packed.size() / 2), bytes.size(), front));
    EXPECT_GT(front.size(), bytes.size() / 8);
    EXPECT_TRUE(std::equal(front.begin(), front.end(), bytes.begin()));
  }
}

TEST(ChunkCompression, NeverExceedsItsLimit) {
  const Buffer bytes(16 << 20);
  for (const Compression compression : kPacking) {
    Buffer packed;
    Buffer unpacked;
    compress(compression, bytes, packed);
    EXPECT_LT(packed.size(), 100'000);
    EXPECT_FALSE(decompress(compression, packed, 1000, unpacked));
    EXPECT_EQ(unpacked.size(), 1000);
    EXPECT_LT(unpacked.capacity(), std::size_t{1} << 20);
  }
}

TEST(ChunkCompression, RefusesNoiseAndNothing) {
  const Buffer noise(100, 0xa5);
  for (const Compression compression : kPacking) {
    Buffer unpacked;
    EXPECT_FALSE(decompress(compression, noise, 1000, unpacked));
    EXPECT_FALSE(decompress(compression, {}, 1000, unpacked));
  }
}

TEST(ChunkCompression, HasTheNamesOfTheFormat) {
  for (const Compression compression :
       {Compression::kNone, Compression::kLz4, Compression::kZstd}) {
    EXPECT_EQ(compression_of(mcap_name(compression)), compression);
  }
  EXPECT_EQ(compression_of("bz2"), std::nullopt);
}

// The check value of CRC-32 (ITU-T V.42), published for these nine digits.
TEST(Crc32, IsThatOfTheStandard) {
  EXPECT_EQ(crc32_of(bytes_of("123456789")), 0xcbf43926U);
  EXPECT_EQ(crc32_of(bytes_of("6789"), crc32_of(bytes_of("12345"))), 0xcbf43926U);
  EXPECT_EQ(crc32_of_both(crc32_of(bytes_of("12345")), crc32_of(bytes_of("6789")), 4), 0xcbf43926U);
  EXPECT_EQ(crc32_of({}), 0U);
}

}  // namespace
}  // namespace sparsight
