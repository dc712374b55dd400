#include "tools/graph/g2o_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>

#include "slam/graph/cold_solution.h"
#include "slam/graph/edge_error.h"
#include "tests/build_paths.h"
#include "tools/evaluation/text_file.h"
#include "tools/graph/optimise_graph.h"
#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const std::string kTwoVertices =
    "VERTEX_SE3:QUAT 7 0 0 0 0 0 0 1\n"
    "VERTEX_SE3:QUAT 8 1 2 3 0 0 0.6 0.8\n";
// Information 1 to 6 on the diagonal.
const std::string kInformation = "1 0 0 0 0 0 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6";
const std::string kEdgeLine = "EDGE_SE3:QUAT 7 8 1 2 3 0 0 0.6 0.8 " + kInformation + "\n";

std::string g2o_error(const std::string& text) {
  const auto file = parse_g2o(text, "a.g2o");
  return file ? "no error" : file.error().message;
}

TEST(G2oFile, ReadsVerticesAndEdgesInAnyOrder) {
  const auto file = parse_g2o(kEdgeLine + "# a remark\n\n" + kTwoVertices + "FIX 8\n", "a.g2o");
  ASSERT_TRUE(file) << file.error().message;
  ASSERT_EQ(file->ids, (std::vector<std::int64_t>{7, 8}));
  const PoseEdge& edge = file->graph.edges.at(0);
  EXPECT_FALSE(edge.loop);
  EXPECT_EQ(edge_chi2(file->graph, edge), 0.0);
  EXPECT_EQ(file->graph.held, (std::vector<std::size_t>{1}));
}

TEST(G2oFile, InformationIsOfTheErrorOnTheRightWithTheTranslationFirst) {
  auto file = parse_g2o(kTwoVertices + kEdgeLine, "a.g2o");
  ASSERT_TRUE(file) << file.error().message;
  Eigen::Isometry3d& T = file->graph.T_world_node[1];
  T = T * Eigen::Translation3d(0.0, 0.1, 0.0);
  EXPECT_NEAR(edge_chi2(file->graph, file->graph.edges[0]), 2.0 * 0.01, 1e-12);
  T = file->graph.edges[0].T_from_to * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(edge_chi2(file->graph, file->graph.edges[0]), 6.0 * 0.01, 1e-12);
}

TEST(G2oFile, EdgesOfIdsThatDoNotFollowEachOtherAreLoops) {
  const auto file = parse_g2o(
      "VERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 3 0 0 0 0 0 0 1\n"
      "EDGE_SE3:QUAT 3 1 0 0 0 0 0 0 1 " +
          kInformation + "\n",
      "a.g2o");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_TRUE(file->graph.edges.at(0).loop);
}

TEST(G2oFile, ASecondEdgeBetweenTheSameTwoIsALoopWhicheverWayItPoints) {
  const auto file = parse_g2o(kTwoVertices + kEdgeLine + kEdgeLine +
                                  "EDGE_SE3:QUAT 8 7 0 0 0 0 0 0 1 " + kInformation + "\n",
                              "a.g2o");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_FALSE(file->graph.edges.at(0).loop);
  EXPECT_TRUE(file->graph.edges.at(1).loop);
  EXPECT_TRUE(file->graph.edges.at(2).loop);
}

TEST(G2oFile, ErrorsNameFileLineAndFix) {
  EXPECT_EQ(g2o_error(""), "a.g2o: holds no VERTEX_SE3:QUAT line; is it a g2o file of 3D poses?");
  EXPECT_THAT(g2o_error("VERTEX_SE2 0 0 0 0\n"), HasSubstr("a.g2o:1: 'VERTEX_SE2' is not one of"));
  EXPECT_THAT(g2o_error("VERTEX_SE3:QUAT 0 0 0\n"), HasSubstr("a.g2o:1: 4 fields, but"));
  EXPECT_THAT(g2o_error("VERTEX_SE3:QUAT -1 0 0 0 0 0 0 1\n"), HasSubstr("not a vertex id"));
  EXPECT_THAT(g2o_error("VERTEX_SE3:QUAT 0 0 0 x 0 0 0 1\n"), HasSubstr("a.g2o:1: field 5"));
  EXPECT_THAT(g2o_error("VERTEX_SE3:QUAT 0 0 0 nan 0 0 0 1\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(g2o_error("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 0\n"), HasSubstr("has length 1"));
  EXPECT_THAT(g2o_error("VERTEX_SE3:QUAT 0 1e300 0 0 0 0 0 1\n"), HasSubstr("within +-1e+09"));
  EXPECT_THAT(g2o_error(kTwoVertices + kTwoVertices), HasSubstr("a.g2o:3: VERTEX_SE3:QUAT 7 is"));
  EXPECT_THAT(g2o_error(kTwoVertices + "EDGE_SE3:QUAT 7 9 0 0 0 0 0 0 1 " + kInformation),
              HasSubstr("a.g2o:3: there is no VERTEX_SE3:QUAT 9"));
  EXPECT_THAT(g2o_error(kTwoVertices + "EDGE_SE3:QUAT 7 7 0 0 0 0 0 0 1 " + kInformation),
              HasSubstr("needs two vertices"));
  EXPECT_THAT(g2o_error(kTwoVertices + "EDGE_SE3:QUAT 7 8 0 0 0 0 0 0 1 1 0 0 0 0 0 2 0 0 0 0 -3"
                                       " 0 0 0 4 0 0 5 0 6\n"),
              HasSubstr("fields 11-31 are no information matrix"));
  EXPECT_THAT(g2o_error(kTwoVertices + "EDGE_SE3:QUAT 7 8 0 0 0 0 0 0 1 1 0\n"),
              HasSubstr("12 fields, but this line has 31"));
  EXPECT_THAT(g2o_error(kTwoVertices + "FIX 1\n"), HasSubstr("a.g2o:3: there is no"));
}

TEST(G2oFile, WhatIsWrittenReadsBackTheSame) {
  const auto file = parse_g2o(kTwoVertices + kEdgeLine + "FIX 8\n", "a.g2o");
  ASSERT_TRUE(file);
  const std::string text = format_g2o(*file, {});
  const auto again = parse_g2o(text, "again.g2o");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(format_g2o(*again, {}), text);
  const auto without = parse_g2o(format_g2o(*file, {0}), "without.g2o");
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_TRUE(without->graph.edges.empty());
}

TEST(OptimiseGraph, WritesAFileThatIsAtItsOptimum) {
  const fs::path folder = fs::path(::testing::TempDir()) / "optimise_graph";
  fs::create_directories(folder);
  OptimiseOptions options{.input = folder / "in.g2o", .output = folder / "out.g2o"};
  ASSERT_TRUE(write_file(options.input,
                         "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 9 9 9 0 0 0 1\n"
                         "EDGE_SE3:QUAT 0 1 1 2 3 0 0 0.6 0.8 " +
                             kInformation + "\n"));
  const auto report = optimise_graph(options);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_GT(report->initial_cost, 1.0);
  EXPECT_LT(report->final_cost, 1e-12);
  EXPECT_THAT(optimise_json(*report), HasSubstr("\"final_cost\""));
  EXPECT_THAT(optimise_text(*report), HasSubstr("2 vertices, 1 edges"));
  const auto written = read_text_file(options.output).and_then([](const std::string& text) {
    return parse_g2o(text, "out.g2o");
  });
  ASSERT_TRUE(written);
  EXPECT_LT(graph_cost(written->graph, 0.0), 1e-12);
}

fs::path published_graph(const char* name) { return testing::recordings() / "graphs" / name; }

TEST(OptimiseGraph, ReachesTheOptimumOfAPublishedGraph) {
  const fs::path file = published_graph("smallGrid3D.g2o");
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there; SPARSIGHT_DATA names its folder";
  const auto report = optimise_graph({.input = file});
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_EQ(report->vertices, 125);
  EXPECT_EQ(report->edges, 297);
  EXPECT_TRUE(report->taken_out.empty());
  // The lowest of many descents from anywhere.
  G2oGraph graph = parse_g2o(read_text_file(file).value(), "smallGrid3D.g2o").value();
  std::mt19937 random(1);
  double lowest = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 6; ++start) {
    PoseGraph scattered = graph.graph;
    for (Eigen::Isometry3d& T : scattered.T_world_node) {
      Vector6d anywhere;
      for (double& value : anywhere)
        value = 0.3 * (static_cast<double>(random() % 2001) / 1e3 - 1.0);
      T = T * exp_se3(anywhere);
    }
    const GraphSummary summary =
        optimize(scattered, {.max_iterations = 100, .relative_tolerance = 1e-9, .dcs_phi = 0.0});
    lowest = std::min(lowest, summary.final_cost);
  }
  EXPECT_NEAR(report->final_cost, lowest, 1e-3);
}

// Between any two vertices, from anywhere to anywhere, a tenth of the true ones, with the
// information of a true one.
std::string with_false_loops(std::string text, const G2oGraph& clean, unsigned seed) {
  std::mt19937 random(seed);
  const auto any = [&](double reach) {
    return reach * (static_cast<double>(random() % 20001) / 1e4 - 1.0);
  };
  const std::string& true_loop = clean.edge_fields.back();
  std::size_t at = 0;
  for (int field = 0; field < 10; ++field) at = true_loop.find(' ', at) + 1;
  const std::string information = true_loop.substr(at);
  for (int i = 0; i < 17; ++i) {
    const auto from = clean.ids[random() % clean.ids.size()];
    auto to = from;
    while (to == from) to = clean.ids[random() % clean.ids.size()];
    const Eigen::Quaterniond q =
        Eigen::Quaterniond(any(1.0), any(1.0), any(1.0), any(1.0)).normalized();
    text += fmt::format("EDGE_SE3:QUAT {} {} {} {} {} {} {} {} {} {}\n", from, to, any(3.0),
                        any(3.0), any(3.0), q.x(), q.y(), q.z(), q.w(), information);
  }
  return text;
}

TEST(OptimiseGraph, TakesOutTheFalseLoopsOfAPublishedGraphAndNoTrueOne) {
  const fs::path file = published_graph("smallGrid3D.g2o");
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there; SPARSIGHT_DATA names its folder";
  const std::string text = read_text_file(file).value();
  const G2oGraph clean = parse_g2o(text, "smallGrid3D.g2o").value();
  const double optimum = solve_from_cold(clean.graph, {}).final_cost;
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const G2oGraph dirty = parse_g2o(with_false_loops(text, clean, seed), "dirty.g2o").value();
    const ColdSolution solution = solve_from_cold(dirty.graph, {});
    EXPECT_EQ(solution.taken_out.size(), 17U) << seed;
    EXPECT_NEAR(solution.final_cost, optimum, 1e-3) << seed;
  }
}

}  // namespace
}  // namespace sparsight
