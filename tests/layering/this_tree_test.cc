#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/build_paths.h"
#include "tests/layering/layer_rules.h"
#include "tests/layering/source_tree.h"

namespace sparsight::layering {
namespace {

using ::testing::IsEmpty;

const std::vector<SourceFile>& sources() {
  static const std::vector<SourceFile> kSources = read_sources(testing::source_dir());
  return kSources;
}

TEST(ThisTree, IsRead) {
  EXPECT_TRUE(std::ranges::count(sources(), "hal/frame_source.h", &SourceFile::path));
  EXPECT_TRUE(std::ranges::count(sources(), "tests/layering/this_tree_test.cc", &SourceFile::path));
  const auto main = std::ranges::find(sources(), "tools/sparsight/main.cc", &SourceFile::path);
  ASSERT_NE(main, sources().end());
  EXPECT_TRUE(std::ranges::count(main->includes, "tools/sparsight/command_line.h", &Include::path));
}

TEST(ThisTree, PointsItsLayersOneWay) { EXPECT_THAT(check_layers(sources()), IsEmpty()); }

TEST(ThisTree, KeepsThirdPartyLibrariesInTheirPlace) {
  EXPECT_THAT(check_third_party(sources()), IsEmpty());
}

TEST(ThisTree, EstimatesWithoutThreadClockOrFile) {
  EXPECT_THAT(check_estimation_is_pure(sources()), IsEmpty());
}

TEST(ThisTree, PairsEverySourceWithItsHeader) {
  EXPECT_THAT(check_file_pairs(sources()), IsEmpty());
}

TEST(ThisTree, NamesFoldersAfterConcepts) { EXPECT_THAT(check_folder_names(sources()), IsEmpty()); }

}  // namespace
}  // namespace sparsight::layering
