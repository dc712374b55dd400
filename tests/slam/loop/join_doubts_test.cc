#include "slam/loop/join_doubts.h"

#include <gtest/gtest.h>

#include "tests/slam/loop/two_submaps.h"

namespace sparsight {
namespace {

// Two views of the next door but one, which agreed, have joined the two.
class FalseJoin : public TwoSubmaps {
 protected:
  static constexpr double kDoorsM = 6.4;
  FalseJoin() {
    EXPECT_TRUE(graph.join(std::vector{loop(3, 0, kDoorsM).edge(), loop(5, 0, kDoorsM).edge()}));
  }

  // As the graph refuses it.
  std::optional<RevisedJoin> refused(const SeenAgain& loop) {
    EXPECT_FALSE(graph.add_loop(loop.current, loop.candidate, loop.check.T_current_candidate,
                                loop.check.information));
    return doubts.add(loop, graph, [](std::size_t i) { return i / kKeyframes; });
  }

  JoinDoubts doubts{SubmapJoinConfig{}};
};

TEST_F(FalseJoin, IsMadeAnewWhereManyMoreViewsAgree) {
  EXPECT_FALSE(refused(loop(8)));
  EXPECT_FALSE(refused(loop(10)));
  EXPECT_FALSE(refused(loop(12, 1))) << "three against the two that stand";
  const auto revised = refused(loop(14));
  ASSERT_TRUE(revised);
  EXPECT_EQ(revised->loops.size(), 4);
  EXPECT_FALSE(revised->graph.has(loop(3).edge()));
  EXPECT_FALSE(revised->graph.has(loop(5).edge()));
  EXPECT_TRUE(revised->graph.has(loop(8).edge()));
  for (std::size_t i = 0; i < kKeyframes; ++i) {
    const auto& poses = revised->graph.graph().T_world_node;
    EXPECT_TRUE(poses[i].isApprox(at(static_cast<double>(i)), 1e-6)) << "the older stays";
    EXPECT_TRUE(poses[kKeyframes + i].isApprox(poses[i], 1e-6)) << i;
  }
  EXPECT_TRUE(revised->graph.connected(0, kKeyframes));
}

TEST_F(FalseJoin, StaysWhileWhatSpeaksAgainstItSaysDifferentThings) {
  for (std::size_t i = 6; i < 16; ++i) {
    EXPECT_FALSE(refused(loop(i, 0, -2.0 * static_cast<double>(i))));
  }
}

TEST_F(FalseJoin, StaysWhileAllThatSpeaksAgainstItIsOneView) {
  for (std::size_t ahead = 0; ahead < 6; ++ahead) EXPECT_FALSE(refused(loop(8, ahead)));
}

TEST_F(FalseJoin, StaysWhereAThirdSubmapHoldsTheTwoTogether) {
  graph.begin_submap(at(-50.0));
  const std::size_t third = 2 * kKeyframes;
  graph.add_next(at(1.0), information());
  const auto to_third = [&](std::size_t from, const Eigen::Isometry3d& T_world_third) {
    std::vector<PoseEdge> edges;
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Isometry3d T_world_from = graph.graph().T_world_node[from];
      edges.push_back(
          {.from = from,
           .to = third + i,
           .T_from_to = T_world_from.inverse() * T_world_third * at(static_cast<double>(i)),
           .information = information(),
           .loop = true});
    }
    return edges;
  };
  ASSERT_TRUE(graph.join(to_third(0, at(2.0, 3.0))));
  const auto second = to_third(kKeyframes, at(2.0, 3.0));
  for (const PoseEdge& edge : second) {
    ASSERT_TRUE(graph.add_loop(edge.from, edge.to, edge.T_from_to, edge.information));
  }
  for (std::size_t i = 6; i < 16; ++i) EXPECT_FALSE(refused(loop(i)));
}

TEST_F(FalseJoin, WhatIsRefusedWithinASubmapIsNoDoubt) {
  SeenAgain within = loop(10);
  within.candidate = kKeyframes + 2;
  for (std::size_t i = 0; i < 8; ++i) EXPECT_FALSE(refused(within));
}

}  // namespace
}  // namespace sparsight
