#include "tools/evaluation/rigid_alignment.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points moved(const Eigen::Isometry3d& T, Points points) {
  for (Eigen::Vector3d& point : points) {
    point = T * point;
  }
  return points;
}

double largest_distance(const Points& a, const Points& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

RC_GTEST_PROP(RigidAlignment, FindsTheMotionOfPointsInGeneralPosition, ()) {
  const Points points = {{0, 0, 0}, {5, 1, 0}, {2, 7, 1}, {-3, 2, 8}};
  const Eigen::Isometry3d T = testing::arbitrary_pose(1000.0);
  RC_ASSERT(align_rigidly(moved(T, points), points).isApprox(T, 1e-12));
}

RC_GTEST_PROP(RigidAlignment, BringsAStraightPathOntoItsMovedCopyByARotation, ()) {
  Points points;
  for (int i = 0; i < 20; ++i) {
    points.emplace_back(0.0, 0.0, 1.3 * i);
  }
  const Points target = moved(testing::arbitrary_pose(1000.0), points);
  const Eigen::Isometry3d T = align_rigidly(target, points);
  RC_ASSERT(std::abs(T.linear().determinant() - 1.0) < 1e-12);
  RC_ASSERT(largest_distance(moved(T, points), target) < 1e-9);
}

TEST(RigidAlignment, NeverMirrors) {
  // The best orthogonal matrix between a tetrahedron and its mirror image is a reflection.
  const Points points = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {0, 0, 0}};
  Points mirrored = points;
  for (Eigen::Vector3d& point : mirrored) {
    point.x() = -point.x();
  }
  EXPECT_NEAR(align_rigidly(mirrored, points).linear().determinant(), 1.0, 1e-12);
}

TEST(RigidAlignment, BringsASinglePlaceOntoTheOther) {
  const Points here(3, Eigen::Vector3d(1, 2, 3));
  const Points there(3, Eigen::Vector3d(-4, 5, 6));
  const Eigen::Isometry3d T = align_rigidly(there, here);
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
  EXPECT_LT((T * here[0] - there[0]).norm(), 1e-12);
}

// Of all rigid motions the answer must have the least squares: no small change may improve it.
RC_GTEST_PROP(RigidAlignment, IsBetterThanItsNeighbours, ()) {
  Points source;
  Points target;
  for (int i = 0; i < 6; ++i) {
    source.push_back(testing::arbitrary_vector(10.0));
    target.push_back(testing::arbitrary_vector(10.0));
  }
  const auto squares = [&](const Eigen::Isometry3d& T) {
    double sum = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      sum += (T * source[i] - target[i]).squaredNorm();
    }
    return sum;
  };
  const Eigen::Isometry3d best = align_rigidly(target, source);
  const Eigen::Isometry3d nearby =
      testing::pose(testing::arbitrary_vector(0.1), testing::arbitrary_vector(0.1)) * best;
  RC_ASSERT(squares(best) <= squares(nearby) + 1e-9);
}

}  // namespace
}  // namespace sparsight
