#include "tools/benchmark/aligned_table.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

TEST(AlignedTable, IsMarkdownWithColumnsOfOneWidth) {
  EXPECT_EQ(aligned_table({{"seq", "t"}, {"04†", "12.50"}}),
            "| seq |     t |\n"
            "| --: | ----: |\n"
            "| 04† | 12.50 |\n");
}

}  // namespace
}  // namespace sparsight
