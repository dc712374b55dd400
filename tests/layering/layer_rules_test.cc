#include "tests/layering/layer_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

// The rules can fail: each is shown a tree that breaks it, and its neighbour that does not.
namespace sparsight::layering {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SourceFile file(const std::string& path, const std::string& text) {
  return {.path = path, .text = text, .includes = find_includes(text)};
}

SourceFile including(const std::string& path, const std::string& header) {
  return file(path, "#include " + header + "\n");
}

struct Edge {
  std::string from;
  std::string to;
};
std::string name(const ::testing::TestParamInfo<Edge>& edge) {
  return edge.param.from + "_to_" + edge.param.to;
}
void PrintTo(const Edge& edge, std::ostream* out) { *out << edge.from << " to " << edge.to; }

class ForbiddenEdge : public ::testing::TestWithParam<Edge> {};
TEST_P(ForbiddenEdge, IsNamedWithItsLine) {
  const auto& [from, to] = GetParam();
  const std::string header = to + "/thing.h";
  const SourceFile source =
      file(from + "/part/user.cc", "#include <vector>\n#include \"" + header + "\"\n");
  EXPECT_THAT(check_layers({source}),
              ElementsAre(HasSubstr(from + "/part/user.cc:2: includes " + header)));
}
INSTANTIATE_TEST_SUITE_P(
    Layers, ForbiddenEdge,
    ::testing::Values(Edge{"hal", "drivers"}, Edge{"hal", "slam"}, Edge{"hal", "realtime"},
                      Edge{"hal", "tools"}, Edge{"drivers", "slam"}, Edge{"slam", "drivers"},
                      Edge{"drivers", "realtime"}, Edge{"realtime", "drivers"},
                      Edge{"drivers", "tools"}, Edge{"slam", "realtime"}, Edge{"slam", "tools"},
                      Edge{"realtime", "tools"}, Edge{"hal", "tests"}, Edge{"drivers", "tests"},
                      Edge{"slam", "tests"}, Edge{"realtime", "tests"}, Edge{"tools", "tests"}),
    name);

class AllowedEdge : public ::testing::TestWithParam<Edge> {};
TEST_P(AllowedEdge, IsAccepted) {
  const auto& [from, to] = GetParam();
  EXPECT_THAT(check_layers({including(from + "/user.cc", "\"" + to + "/thing.h\"")}), IsEmpty());
}
INSTANTIATE_TEST_SUITE_P(Layers, AllowedEdge,
                         ::testing::Values(Edge{"hal", "hal"}, Edge{"drivers", "hal"},
                                           Edge{"slam", "hal"}, Edge{"slam", "slam"},
                                           Edge{"realtime", "slam"}, Edge{"realtime", "hal"},
                                           Edge{"tools", "drivers"}, Edge{"tools", "realtime"},
                                           Edge{"tools", "slam"}, Edge{"tools", "hal"},
                                           Edge{"tests", "drivers"}, Edge{"tests", "slam"}),
                         name);

TEST(LayerRules, RefusePathsThatAreNotFromTheTop) {
  EXPECT_THAT(check_layers({including("slam/a.cc", "\"b.h\"")}), ElementsAre(HasSubstr("b.h")));
  EXPECT_THAT(check_layers({including("slam/a.cc", "\"../drivers/b.h\"")}),
              ElementsAre(HasSubstr("../drivers/b.h")));
  EXPECT_THAT(check_layers({including("slam/a.cc", "<drivers/b.h>")}),
              ElementsAre(HasSubstr("drivers/b.h")));
}

TEST(LayerRules, ReadNoIncludeFromAComment) {
  const char* text = R"(// #include "drivers/a.h"
/* #include "drivers/b.h"
#include "drivers/c.h"
*/
#include "hal/d.h"  /* one line */
#  include "hal/e.h"
)";
  std::vector<std::string> paths;
  for (const Include& include : find_includes(text)) paths.push_back(include.path);
  EXPECT_THAT(paths, ElementsAre("hal/d.h", "hal/e.h"));
}

TEST(LibraryRules, KeepHeavyLibrariesOutOfHeaders) {
  for (const char* header : {"<Eigen/Dense>", "<opencv2/core.hpp>", "<ceres/ceres.h>"}) {
    EXPECT_THAT(check_third_party({including("drivers/a.h", header)}), ::testing::SizeIs(1))
        << header;
  }
  for (const char* header : {"<Eigen/Geometry>", "<Eigen/Eigenvalues>"}) {
    EXPECT_THAT(check_third_party({including("slam/a.h", header)}), IsEmpty()) << header;
  }
}

TEST(LibraryRules, KeepEachLibraryInItsLayer) {
  EXPECT_THAT(check_third_party({including("drivers/a.cc", "<opencv2/imgcodecs.hpp>")}), IsEmpty());
  EXPECT_THAT(check_third_party({including("slam/a.cc", "<opencv2/imgcodecs.hpp>")}),
              ElementsAre(HasSubstr("slam/a.cc:1")));
  EXPECT_THAT(check_third_party({including("tools/a.cc", "<toml++/toml.h>")}), IsEmpty());
  EXPECT_THAT(check_third_party({including("slam/a.cc", "<toml++/toml.h>")}),
              ElementsAre(HasSubstr("objects take values")));
  EXPECT_THAT(check_third_party({including("drivers/a.cc", "<nlohmann/json.hpp>")}), IsEmpty());
  EXPECT_THAT(check_third_party({including("slam/a.cc", "<nlohmann/json.hpp>")}),
              ElementsAre(HasSubstr("slam/a.cc:1")));
  EXPECT_THAT(check_third_party({including("drivers/a.cc", "<pcap/pcap.h>")}), IsEmpty());
  EXPECT_THAT(check_third_party({including("drivers/a.h", "<httplib.h>")}),
              ElementsAre(HasSubstr("drivers/a.h:1")));
}

TEST(EstimationRules, RefuseThreadsFilesAndClocksInSlamOnly) {
  EXPECT_THAT(check_estimation_is_pure({including("slam/a.cc", "<thread>")}),
              ElementsAre(HasSubstr("slam/a.cc:1")));
  EXPECT_THAT(check_estimation_is_pure({including("slam/a.cc", "<fstream>")}),
              ElementsAre(HasSubstr("slam/a.cc:1")));
  EXPECT_THAT(check_estimation_is_pure({file("slam/a.cc", "auto t = HostClock::now();")}),
              ElementsAre(HasSubstr("no clock")));
  EXPECT_THAT(check_estimation_is_pure({including("realtime/a.cc", "<thread>")}), IsEmpty());
  EXPECT_THAT(check_estimation_is_pure({including("slam/a.cc", "<chrono>")}), IsEmpty());
}

TEST(NamingRules, WantAHeaderForEverySourceOfALibrary) {
  EXPECT_THAT(check_file_pairs({file("slam/a.cc", ""), file("slam/b/a.h", "")}),
              ElementsAre(HasSubstr("slam/a.cc: has no header slam/a.h")));
  EXPECT_THAT(check_file_pairs({file("slam/a.cc", ""), file("slam/a.h", "")}), IsEmpty());
  EXPECT_THAT(check_file_pairs({file("tools/main.cc", ""), file("tests/a_test.cc", "")}),
              IsEmpty());
}

TEST(NamingRules, RefuseFoldersAndFilesNamedAfterNothing) {
  for (const char* path :
       {"slam/util/a.h", "hal/common/a.h", "tests/helpers/a.h", "slam/utils.h"}) {
    EXPECT_THAT(check_folder_names({file(path, "")}), ElementsAre(HasSubstr(path)));
  }
  EXPECT_THAT(check_folder_names({file("slam/window/common_view.h", "")}), IsEmpty());
}

}  // namespace
}  // namespace sparsight::layering
