#include "slam/loop/pose_from_matches.h"

#include <opencv2/calib3d.hpp>

namespace sparsight {

std::optional<PoseFromMatches> pose_from_matches(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<Eigen::Vector2d>& normalized,
                                                 double tolerance, int min_inliers) {
  constexpr int kFewest = 6;  // what the solver needs
  if (static_cast<int>(points.size()) < std::max(kFewest, min_inliers)) return std::nullopt;
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  object.reserve(points.size());
  image.reserve(normalized.size());
  for (const Eigen::Vector3d& p : points) object.emplace_back(p.x(), p.y(), p.z());
  for (const Eigen::Vector2d& p : normalized) image.emplace_back(p.x(), p.y());
  constexpr int kDraws = 300;
  constexpr double kConfidence = 0.999;
  cv::Mat rotation_vector;
  cv::Mat translation;
  std::vector<int> inliers;
  const bool found = cv::solvePnPRansac(
      object, image, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), rotation_vector, translation, false,
      kDraws, static_cast<float>(tolerance), kConfidence, inliers, cv::SOLVEPNP_EPNP);
  if (!found || static_cast<int>(inliers.size()) < min_inliers) return std::nullopt;
  const Eigen::Map<const Eigen::Vector3d> turn(rotation_vector.ptr<double>());
  const Eigen::Map<const Eigen::Vector3d> shift(translation.ptr<double>());
  if (!turn.allFinite() || !shift.allFinite()) return std::nullopt;
  PoseFromMatches result{.inliers = static_cast<int>(inliers.size())};
  if (turn.norm() > 0.0) {
    result.T_camera_points.linear() =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  }
  result.T_camera_points.translation() = shift;
  return result;
}

}  // namespace sparsight
