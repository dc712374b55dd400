#include "drivers/simulated/made_ahead.h"

#include <gtest/gtest.h>

namespace sparsight::simulated {
namespace {

TEST(MadeAhead, GivesWhatIsAskedForInOrder) {
  MadeAhead<std::uint64_t> squares([](std::uint64_t i) { return i * i; }, 3);
  for (std::uint64_t i = 0; i < 20; ++i) EXPECT_EQ(squares.take(i, 20), i * i);
}

TEST(MadeAhead, LeavesOutWhatIsSkipped) {
  MadeAhead<std::uint64_t> squares([](std::uint64_t i) { return i * i; }, 2);
  EXPECT_EQ(squares.take(0, 20), 0U);
  EXPECT_EQ(squares.take(7, 20), 49U);
  EXPECT_EQ(squares.take(8, 20), 64U);
}

}  // namespace
}  // namespace sparsight::simulated
