#include <gtest/gtest.h>
#include <malloc.h>

#include "slam/loop/loop_closer.h"
#include "tests/drivers/datasets/small_dataset.h"
#include "tests/tools/map/made_keyframe.h"
#include "tools/loop/vocabulary_file.h"
#include "tools/map/paged_keyframes.h"

namespace sparsight {
namespace {

// Headers of others define __has_feature where the compiler does not.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SPARSIGHT_OTHER_MALLOC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SPARSIGHT_OTHER_MALLOC
#endif
#endif

// What the C library has handed out.
std::size_t allocated_bytes() {
#ifdef SPARSIGHT_OTHER_MALLOC
  return 0;
#else
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#endif
}

// A rig of 4 GB walks for hours. tests/benchmarks/keyframe_memory_benchmark.cc looks at thousands.
TEST(KeyframeMemory, OfAKeyframeAtMostAHundredKilobytesStayInMemory) {
#ifdef SPARSIGHT_OTHER_MALLOC
  GTEST_SKIP() << "a sanitizer's malloc does not tell what it handed out";
#endif
  const testing::TemporaryFolder folder;
  const auto keyframes = std::make_shared<PagedKeyframes>();
  keyframes->write_to(KeyframeFile::create(folder.path() / "keyframes").value());
  LoopCloser loops(OdometryConfig{}, built_in_vocabulary(), keyframes);
  const CameraIntrinsics camera{800, 600, 400, 400, 399.5, 299.5};
  constexpr std::uint64_t kFirst = 10;  // what is allocated once is by then
  constexpr std::uint64_t kKeyframes = 70;
  std::size_t before = 0;
  for (std::uint64_t i = 0; i < kFirst + kKeyframes; ++i) {
    if (i == kFirst) before = allocated_bytes();
    loops.add(testing::made_keyframe(i), camera);
  }
  const double kilobytes =
      1e-3 * (static_cast<double>(allocated_bytes()) - static_cast<double>(before)) / kKeyframes;
  EXPECT_LT(kilobytes, 50.0);  // of 100: the journal and the trajectory have their share
  EXPECT_GT(kilobytes, 5.0) << "measured nothing";
  EXPECT_EQ(keyframes->places().size(), kFirst + kKeyframes);
  EXPECT_TRUE(keyframes->get(3));
}

}  // namespace
}  // namespace sparsight
