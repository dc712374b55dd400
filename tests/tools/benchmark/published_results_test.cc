#include "tools/benchmark/published_results.h"

#include <gtest/gtest.h>

#include <string>

namespace sparsight {
namespace {

// The averages the paper prints under its rows, which it rounds to two digits.
TEST(PublishedResults, HaveTheAveragesOfTheTable) {
  PublishedErrors sum{};
  for (int i = 0; i <= 10; ++i) {
    const std::string name = (i < 10 ? "0" : "") + std::to_string(i);
    const auto row = published_errors(name);
    ASSERT_TRUE(row) << name;
    sum.demo += row->demo;
    sum.dvl_64 += row->dvl_64;
    sum.dvl_16 += row->dvl_16;
    sum.dvl_8 += row->dvl_8;
  }
  EXPECT_NEAR(sum.demo / 11.0, 1.16, 0.005);
  EXPECT_NEAR(sum.dvl_64 / 11.0, 0.98, 0.005);
  EXPECT_NEAR(sum.dvl_16 / 11.0, 0.98, 0.005);
  EXPECT_NEAR(sum.dvl_8 / 11.0, 1.52, 0.005);
}

TEST(PublishedResults, EndWithTheTrainingSequences) {
  EXPECT_FALSE(published_errors("11").has_value());
  EXPECT_FALSE(published_errors("").has_value());
}

}  // namespace
}  // namespace sparsight
