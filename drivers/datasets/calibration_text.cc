#include "drivers/datasets/calibration_text.h"

#include <fmt/format.h>

#include <cmath>

#include "drivers/datasets/text_lines.h"

namespace sparsight {
namespace {

// Printed rotations are orthonormal within their last digit; 1e-3 lets hand-typed ones pass.
constexpr double kRotationTolerance = 1e-3;

Result<Eigen::Matrix3d> checked_rotation(const CalibrationText& text, const std::string& field,
                                         const Eigen::Matrix3d& R) {
  const double defect = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (defect > kRotationTolerance || R.determinant() < 0.0) {
    return text.refuse(field, "its 3x3 part is not a rotation matrix");
  }
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

}  // namespace

Result<CalibrationText> CalibrationText::parse(std::string_view text, std::string file) {
  CalibrationText calibration;
  calibration.file_ = std::move(file);
  std::size_t number = 0;
  for (const std::string_view line : split_lines(text)) {
    ++number;
    if (split_words(line).empty()) continue;
    const std::size_t colon = line.find(':');
    if (colon == 0 || colon == std::string_view::npos) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: expected \"NAME: values\"", calibration.file_, number));
    }
    const auto [known, inserted] = calibration.fields_.try_emplace(
        std::string(line.substr(0, colon)), Field{number, std::string(line.substr(colon + 1))});
    if (!inserted) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: field {} is given a second time (first in line {})",
                              calibration.file_, number, known->first, known->second.line));
    }
  }
  return calibration;
}

Result<std::vector<double>> CalibrationText::numbers(const std::string& field,
                                                     std::size_t count) const {
  const auto known = fields_.find(field);
  if (known == fields_.end()) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: field {} is missing; add a line \"{}: \" with its {} numbers",
                            file_, field, field, count));
  }
  std::vector<double> numbers;
  for (const std::string_view word : split_words(known->second.values)) {
    const std::optional<double> number = number_from<double>(word);
    if (!number || !std::isfinite(*number)) {
      return refuse(field, fmt::format("\"{}\" is not a number", word.substr(0, 40)));
    }
    numbers.push_back(*number);
  }
  if (numbers.size() != count) {
    return refuse(field, fmt::format("{} numbers, expected {}", numbers.size(), count));
  }
  return numbers;
}

Result<Eigen::Matrix3d> CalibrationText::rotation(const std::string& field) const {
  const auto values = numbers(field, 9);
  if (!values) return tl::unexpected(values.error());
  return checked_rotation(
      *this, field, Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values->data()));
}

Result<Eigen::Isometry3d> CalibrationText::transform(const std::string& field) const {
  const auto values = numbers(field, 12);
  if (!values) return tl::unexpected(values.error());
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(values->data());
  const auto R = checked_rotation(*this, field, matrix.leftCols<3>());
  if (!R) return tl::unexpected(R.error());
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = *R;
  T.translation() = matrix.col(3);
  return T;
}

tl::unexpected<Error> CalibrationText::refuse(const std::string& field,
                                              const std::string& why) const {
  const auto known = fields_.find(field);
  const std::size_t line = known == fields_.end() ? 0 : known->second.line;
  return fail(ErrorCode::kMalformed, fmt::format("{}:{}: field {}: {}", file_, line, field, why));
}

Result<RectifiedCamera> rectified_camera(const CalibrationText& text, const std::string& field) {
  const auto values = text.numbers(field, 12);
  if (!values) return tl::unexpected(values.error());
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> P(values->data());
  const Eigen::Matrix3d K = P.leftCols<3>();
  const bool pinhole =
      K(0, 1) == 0 && K(1, 0) == 0 && K.row(2).isApprox(Eigen::RowVector3d(0, 0, 1));
  if (!pinhole || K(0, 0) <= 0 || K(1, 1) <= 0) {
    return text.refuse(field, "not of the form fx 0 cx tx 0 fy cy ty 0 0 1 tz with fx, fy > 0");
  }
  RectifiedCamera camera;
  camera.intrinsics.fx = K(0, 0);
  camera.intrinsics.fy = K(1, 1);
  camera.intrinsics.cx = K(0, 2);
  camera.intrinsics.cy = K(1, 2);
  camera.T_camera_reference.translation() = K.inverse() * P.col(3);
  return camera;
}

}  // namespace sparsight
