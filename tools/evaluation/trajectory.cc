#include "tools/evaluation/trajectory.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <array>
#include <cmath>

#include "tools/evaluation/number_lines.h"
#include "tools/evaluation/text_file.h"

namespace sparsight {
namespace {

constexpr std::size_t kKittiFields = 12;
constexpr std::size_t kTumFields = 8;
// Files are rounded to as few as four decimals; anything coarser is not a rotation but a mistake,
// such as columns in another order.
constexpr double kRotationTolerance = 0.01;
constexpr double kFarthest_m = 1e9;  // squares and their sums stay finite

Result<TrajectoryFormat> recognise(const NumberLine& line, const std::string& source) {
  switch (line.fields.size()) {
    case kKittiFields:
      return TrajectoryFormat::kKitti;
    case kTumFields:
      return TrajectoryFormat::kTum;
    default:
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: {} fields; a KITTI pose has 12 numbers, a TUM pose 8 "
                              "(t tx ty tz qx qy qz qw), separated by blanks",
                              source, line.number, line.fields.size()));
  }
}

template <std::size_t kCount>
Result<std::array<double, kCount>> parse_fields(const NumberLine& line, const std::string& source,
                                                std::string_view format) {
  if (line.fields.size() != kCount) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}:{}: {} fields, but a {} pose has {}; is the file cut off here?",
                            source, line.number, line.fields.size(), format, kCount));
  }
  std::array<double, kCount> values{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const Result<double> value = parse_number(line, i, source);
    if (!value) {
      return tl::unexpected(value.error());
    }
    values[i] = *value;
  }
  return values;
}

Result<Eigen::Isometry3d> checked_position(const Eigen::Isometry3d& pose, const NumberLine& line,
                                           const std::string& source) {
  if (pose.translation().cwiseAbs().maxCoeff() > kFarthest_m) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}:{}: the position lies more than {:g} m from the origin; positions "
                            "are in metres",
                            source, line.number, kFarthest_m));
  }
  return pose;
}

Result<Eigen::Isometry3d> parse_kitti_pose(const NumberLine& line, const std::string& source) {
  const auto values = parse_fields<kKittiFields>(line, source, "KITTI");
  if (!values) {
    return tl::unexpected(values.error());
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.matrix().topRows<3>() =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(values->data());
  const Eigen::Matrix3d R = pose.linear();
  if (!(R * R.transpose()).isIdentity(kRotationTolerance) || R.determinant() < 0.0) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}:{}: fields 1-3, 5-7 and 9-11 are not a rotation matrix; a KITTI "
                            "pose is the upper 3x4 of camera-to-world, row by row",
                            source, line.number));
  }
  return checked_position(pose, line, source);
}

Result<Eigen::Isometry3d> parse_tum_pose(const NumberLine& line, const std::string& source) {
  const auto values = parse_fields<kTumFields>(line, source, "TUM");
  if (!values) {
    return tl::unexpected(values.error());
  }
  const auto& [time, tx, ty, tz, qx, qy, qz, qw] = *values;
  const Eigen::Quaterniond q(qw, qx, qy, qz);
  if (!(std::abs(q.norm() - 1.0) < kRotationTolerance)) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("{}:{}: fields 5-8 (qx qy qz qw) have length {:.3g}, but a rotation's "
                            "quaternion has length 1",
                            source, line.number, q.norm()));
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() << tx, ty, tz;
  return checked_position(pose, line, source);
}

Result<HostTime> parse_time(const NumberLine& line, const std::string& source) {
  return parse_seconds(line, 0, source).map([](auto since_zero) { return HostTime(since_zero); });
}

tl::unexpected<Error> time_goes_back(const NumberLine& line, const std::string& source) {
  return fail(ErrorCode::kOutOfRange,
              fmt::format("{}:{}: field 1, the time {}, is before that of the line above; sort the "
                          "file by time (sort -g)",
                          source, line.number, line.fields[0]));
}

}  // namespace

Result<Trajectory> parse_trajectory(std::string_view text, const std::string& source,
                                    std::optional<TrajectoryFormat> format) {
  Trajectory trajectory{.source = source};
  for (const NumberLine& line : split_number_lines(text)) {
    if (!format) {
      const Result<TrajectoryFormat> recognised = recognise(line, source);
      if (!recognised) {
        return tl::unexpected(recognised.error());
      }
      format = *recognised;
    }
    const bool tum = format == TrajectoryFormat::kTum;
    const auto pose = tum ? parse_tum_pose(line, source) : parse_kitti_pose(line, source);
    if (!pose) {
      return tl::unexpected(pose.error());
    }
    trajectory.poses.push_back(*pose);
    if (tum) {
      const Result<HostTime> time = parse_time(line, source);
      if (!time) {
        return tl::unexpected(time.error());
      }
      if (!trajectory.times.empty() && *time < trajectory.times.back()) {
        return time_goes_back(line, source);
      }
      trajectory.times.push_back(*time);
    }
  }
  if (trajectory.poses.empty()) {
    return fail(ErrorCode::kMissingField, fmt::format("{}: holds no pose", source));
  }
  return trajectory;
}

Result<std::vector<HostTime>> parse_times(std::string_view text, const std::string& source) {
  std::vector<HostTime> times;
  for (const NumberLine& line : split_number_lines(text)) {
    if (line.fields.size() != 1) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: {} fields; KITTI times have one number a line, in seconds",
                              source, line.number, line.fields.size()));
    }
    const Result<HostTime> time = parse_time(line, source);
    if (!time) {
      return tl::unexpected(time.error());
    }
    if (!times.empty() && *time < times.back()) {
      return time_goes_back(line, source);
    }
    times.push_back(*time);
  }
  return times;
}

Result<Trajectory> read_trajectory(const std::filesystem::path& file,
                                   std::optional<TrajectoryFormat> format) {
  return read_text_file(file).and_then(
      [&](const std::string& text) { return parse_trajectory(text, file.string(), format); });
}

Result<std::vector<HostTime>> read_times(const std::filesystem::path& file) {
  return read_text_file(file).and_then(
      [&](const std::string& text) { return parse_times(text, file.string()); });
}

std::string format_kitti(const std::vector<Eigen::Isometry3d>& poses) {
  std::string text;
  for (const Eigen::Isometry3d& pose : poses) {
    for (int i = 0; i < 12; ++i) {
      fmt::format_to(std::back_inserter(text), "{:.17g}{}", pose(i / 4, i % 4),
                     i == 11 ? '\n' : ' ');
    }
  }
  return text;
}

std::string tum_line(HostTime time, const Eigen::Isometry3d& T_world_camera) {
  const std::int64_t time_ns = time.time_since_epoch().count();
  const std::uint64_t magnitude =
      time_ns < 0 ? -static_cast<std::uint64_t>(time_ns) : static_cast<std::uint64_t>(time_ns);
  const Eigen::Vector3d t = T_world_camera.translation();
  const Eigen::Quaterniond q(T_world_camera.linear());
  return fmt::format("{}{}.{:09} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n",
                     time_ns < 0 ? "-" : "", magnitude / 1'000'000'000, magnitude % 1'000'000'000,
                     t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

std::string format_tum(const Trajectory& trajectory) {
  std::string text = kTumHeader;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    text += tum_line(trajectory.times[i], trajectory.poses[i]);
  }
  return text;
}

Result<Trajectory> with_times(Trajectory trajectory, const std::vector<HostTime>& times,
                              const std::string& times_source) {
  const std::size_t frames = trajectory.poses.size();
  if (times.size() < frames) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: has {} times for the {} poses of {}; give the times.txt of the "
                            "same sequence",
                            times_source, times.size(), frames, trajectory.source));
  }
  trajectory.times.assign(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(frames));
  return trajectory;
}

Trajectory with_exact_rotations(Trajectory trajectory) {
  for (Eigen::Isometry3d& pose : trajectory.poses) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(pose.linear(),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  }
  return trajectory;
}

}  // namespace sparsight
