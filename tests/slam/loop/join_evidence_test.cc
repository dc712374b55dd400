#include "slam/loop/join_evidence.h"

#include <gtest/gtest.h>

#include "tests/slam/loop/two_submaps.h"

namespace sparsight {
namespace {

TEST_F(TwoSubmaps, ArentJoinedByOneView) {
  EXPECT_TRUE(evidence.add(loop(3), graph).empty());
  EXPECT_EQ(evidence.waiting(), 1);
}

TEST_F(TwoSubmaps, AreJoinedByTwoViewsThatSayTheSame) {
  EXPECT_TRUE(evidence.add(loop(3), graph).empty());
  const auto agreeing = evidence.add(loop(5, 1), graph);
  ASSERT_EQ(agreeing.size(), 2);
  EXPECT_TRUE(graph.join(std::vector{agreeing[0].edge(), agreeing[1].edge()}));
  for (std::size_t i = 0; i < kKeyframes; ++i) {
    EXPECT_TRUE(
        graph.graph().T_world_node[kKeyframes + i].isApprox(graph.graph().T_world_node[i], 1e-6));
    EXPECT_TRUE(graph.graph().T_world_node[i].isApprox(at(static_cast<double>(i)), 1e-6))
        << "the older stays where it is";
  }
  EXPECT_TRUE(graph.connected(0, 2 * kKeyframes - 1));
  evidence.drop_connected(graph);
  EXPECT_EQ(evidence.waiting(), 0);
}

TEST_F(TwoSubmaps, TheSameDoorSeenTwiceIsOnePieceOfEvidence) {
  EXPECT_TRUE(evidence.add(loop(3), graph).empty());
  EXPECT_TRUE(evidence.add(loop(3, 1), graph).empty()) << "from the same place, of one a step on";
  EXPECT_FALSE(evidence.add(loop(4), graph).empty());
}

TEST_F(TwoSubmaps, ViewsThatSayDifferentThingsJoinNothing) {
  EXPECT_TRUE(evidence.add(loop(3), graph).empty());
  EXPECT_TRUE(evidence.add(loop(6, 0, 2.5), graph).empty()) << "the next door";
  EXPECT_TRUE(evidence.add(loop(8), graph).empty()) << "two against one";
  EXPECT_FALSE(evidence.add(loop(10), graph).empty()) << "three against one";
}

TEST_F(TwoSubmaps, TheSameTwoViewsComparedAgainAreOnePieceOfEvidence) {
  EXPECT_TRUE(evidence.add(loop(3, 0, 2.5), graph).empty());
  EXPECT_TRUE(evidence.add(loop(5), graph).empty());
  EXPECT_TRUE(evidence.add(loop(5), graph).empty());
  EXPECT_EQ(evidence.waiting(), 2);
  EXPECT_TRUE(evidence.add(loop(7), graph).empty()) << "two against one";
}

TEST_F(TwoSubmaps, DoubtfulViewsAreNoEvidence) {
  SeenAgain few = loop(3);
  few.check.pose_inliers = 26;
  SeenAgain little = loop(5);
  little.check.found_share = 0.65;
  EXPECT_TRUE(evidence.add(few, graph).empty());
  EXPECT_TRUE(evidence.add(little, graph).empty());
  EXPECT_EQ(evidence.waiting(), 0);
}

// A third sub-map is seen to continue the second, and the second is then seen from the third.
TEST_F(TwoSubmaps, ALoopSaysTheSameWhicheverOfTheTwoSeesTheOther) {
  SeenAgain turned = loop(3);
  std::swap(turned.current, turned.candidate);
  turned.check.T_current_candidate = turned.check.T_current_candidate.inverse();
  EXPECT_TRUE(evidence.add(turned, graph).empty());
  EXPECT_EQ(evidence.add(loop(6, 2), graph).size(), 2);
}

TEST_F(TwoSubmaps, TheGraphRefusesLoopsThatContradictEachOther) {
  const PoseGraph before = graph.graph();
  EXPECT_FALSE(graph.join(std::vector{loop(3).edge(), loop(6, 0, 0.5).edge()}));
  EXPECT_FALSE(graph.join(std::vector{loop(3).edge()})) << "one alone contradicts nothing";
  EXPECT_EQ(graph.graph().edges.size(), before.edges.size());
  EXPECT_EQ(graph.graph().T_world_node.back().matrix(), before.T_world_node.back().matrix());
  EXPECT_FALSE(graph.connected(0, kKeyframes));
}

// The one that is tied to the oldest keyframe stays, whichever of its keyframes is older.
TEST_F(TwoSubmaps, TheOneWithoutTheOldestKeyframeMoves) {
  graph.begin_submap(at(-50.0));
  const std::size_t third = 2 * kKeyframes;
  graph.add_next(at(1.0), information());
  const std::vector<PoseEdge> to_second{{.from = kKeyframes,
                                         .to = third,
                                         .T_from_to = at(0.0, 2.0),
                                         .information = information(),
                                         .loop = true},
                                        {.from = kKeyframes + 1,
                                         .to = third + 1,
                                         .T_from_to = at(0.0, 2.0),
                                         .information = information(),
                                         .loop = true}};
  const Eigen::Isometry3d T_second = graph.graph().T_world_node[kKeyframes];
  ASSERT_TRUE(graph.join(to_second));
  EXPECT_TRUE(graph.graph().T_world_node[kKeyframes].isApprox(T_second, 1e-9));
  EXPECT_EQ(graph.part_of(third), kKeyframes);
  ASSERT_TRUE(graph.join(std::vector{loop(3).edge(), loop(6).edge()}));
  EXPECT_EQ(graph.part_of(third), 0);
  EXPECT_TRUE(graph.graph().T_world_node[third].isApprox(at(0.0, 2.0), 1e-6));
}

}  // namespace
}  // namespace sparsight
