#include "tests/layering/document_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/build_paths.h"

namespace sparsight::layering {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> paths_in(const std::string& markdown) {
  std::vector<std::string> paths;
  for (const DocumentPath& path : find_paths(markdown)) paths.push_back(path.path);
  return paths;
}

TEST(DocumentPaths, AreCodeWordsBelowATopFolderAndLinks) {
  EXPECT_THAT(paths_in("See `slam/odometry.h`, `hal/` and [frames](docs/frames.md#axes)."),
              ElementsAre("slam/odometry.h", "hal/", "docs/frames.md"));
  EXPECT_THAT(paths_in("Run `./tools/check --quick`"), ElementsAre("./tools/check"));
  EXPECT_THAT(paths_in("The pair `slam/tracking/tracker.{h,cc}`"),
              ElementsAre("slam/tracking/tracker.h", "slam/tracking/tracker.cc"));
}

TEST(DocumentPaths, AreNotAddressesPlaceholdersOrProducts) {
  EXPECT_THAT(paths_in("[KITTI](https://www.cvlibs.net/datasets/kitti/) `tests/<sub-path>/x.cc` "
                       "`build/release/sparsight` `T_world_camera` slam/in_prose.h"),
              IsEmpty());
}

TEST(DocumentPaths, AreReportedWithTheirLineWhenMissing) {
  const fs::path top = fs::path{::testing::TempDir()} / "document_paths";
  fs::create_directories(top / "docs");
  fs::create_directories(top / "hal");
  std::ofstream{top / "hal" / "there.h"} << "\n";
  std::ofstream{top / "docs" / "page.md"} << "`hal/there.h`\n\n`hal/gone.h` [x](gone.md)\n";
  EXPECT_THAT(check_document(top, "docs/page.md"),
              ElementsAre("docs/page.md:3: no such file: hal/gone.h",
                          "docs/page.md:3: no such file: gone.md"));
  fs::remove_all(top);
}

TEST(ThisTree, HasEveryFileItsDocumentsName) {
  const fs::path top = testing::source_dir();
  std::vector<fs::path> documents = {"README.md", "CHANGELOG.md"};
  for (const fs::directory_entry& entry : fs::directory_iterator{top / "docs"}) {
    if (entry.path().extension() == ".md") documents.push_back(fs::relative(entry.path(), top));
  }
  for (const fs::path& document : documents) {
    ASSERT_TRUE(fs::exists(top / document)) << document;
    EXPECT_THAT(check_document(top, document), IsEmpty());
  }
}

}  // namespace
}  // namespace sparsight::layering
