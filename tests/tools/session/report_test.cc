#include "tools/session/report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/session/sample_session.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string report_of(const Session& session) { return report_html(session, summarize(session)); }

std::filesystem::path truth_file() {
  return std::filesystem::path(::testing::TempDir()) / "report_truth.txt";
}

TEST(Report, ShowsKeyFiguresAndChartsAgainstGroundTruth) {
  const Session session = sample_session(600, truth_file());
  const std::string html = report_of(session);
  ASSERT_TRUE(write_file(std::filesystem::path(::testing::TempDir()) / "report.html", html));
  const std::string t_rel = fmt::format("{:.2f} %", *session.truth->evaluation.kitti.t_rel_percent);
  EXPECT_THAT(html, HasSubstr("<b>" + t_rel + "</b><span>t_rel"));
  EXPECT_THAT(html, HasSubstr("<b>598 of 600</b><span>frames tracked"));
  EXPECT_THAT(html, HasSubstr("ground truth</span>"));
  EXPECT_THAT(html, HasSubstr("Translation error by segment length"));
  EXPECT_THAT(html, HasSubstr("Faults: 2"));
}

TEST(Report, WithoutGroundTruthSaysNothingOfDrift) {
  const std::string html = report_of(sample_session(300));
  EXPECT_THAT(html, Not(HasSubstr("t_rel")));
  EXPECT_THAT(html, Not(HasSubstr("Drift")));
  EXPECT_THAT(html, HasSubstr("Path from above"));
}

TEST(Report, AsksForNothingFromOutsideAndEscapesWhatItQuotes) {
  Session session = sample_session(300);
  session.description.source = "a<b>&c";
  const std::string html = report_of(session);
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("a<b>")));
  EXPECT_THAT(html, HasSubstr("a&lt;b&gt;&amp;c"));
  EXPECT_THAT(html, HasSubstr("cut off &lt;after&gt; 12 rows"));
}

TEST(Report, StaysLightForManyFrames) {
  EXPECT_LT(report_of(sample_session(20000)).size(), 600'000U);
}

TEST(Report, SessionWithoutFramesStillMakesAPage) {
  const std::string html = report_of(Session{});
  EXPECT_THAT(html, HasSubstr("</html>"));
  EXPECT_THAT(html, Not(HasSubstr("nan")));
  EXPECT_THAT(html, Not(HasSubstr("inf")));
}

TEST(Report, IncompleteSessionAndNotesAreShown) {
  Session session = sample_session(20);
  session.broke_off = "stopped on request";
  session.notes.emplace_back("the ground truth is <elsewhere>");
  EXPECT_THAT(report_of(session), HasSubstr("Not complete: stopped on request"));
  EXPECT_THAT(report_of(session), HasSubstr("the ground truth is &lt;elsewhere&gt;"));
}

}  // namespace
}  // namespace sparsight
