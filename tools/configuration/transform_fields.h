#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>

#include "tools/configuration/field_range.h"

namespace sparsight {

// A transform as files see it: a translation and a unit quaternion (w first), or the upper three
// rows of the 4x4 matrix, which keep every digit.
struct TransformFields {
  std::optional<std::array<double, 3>> translation_m;
  std::optional<std::array<double, 4>> quaternion_wxyz;
  std::optional<std::array<std::array<double, 4>, 3>> matrix;
  std::string meaning;  // "p_a = T_a_b * p_b"; not in the file
};

TransformFields fields_of(const Eigen::Isometry3d& T);
// Of checked fields. What was written with few digits is turned into the nearest true rotation.
Eigen::Isometry3d isometry_of(const TransformFields& fields);

// Within what rounding to four digits does.
bool is_unit_quaternion(const TransformFields& fields);
bool is_rotation(const TransformFields& fields);

template <typename Visitor>
void visit_fields(Visitor& file, TransformFields& T) {
  file.field("translation_m", T.translation_m, {-100.0, 100.0});
  file.field("quaternion_wxyz", T.quaternion_wxyz, {-1.01, 1.01});
  file.field("matrix", T.matrix, {-100.0, 100.0});
  const bool split = T.translation_m && T.quaternion_wxyz;
  file.check("matrix", T.matrix ? !T.translation_m && !T.quaternion_wxyz : split,
             "give translation_m and quaternion_wxyz, or matrix (3 rows of 4) alone: " + T.meaning);
  file.check("quaternion_wxyz", is_unit_quaternion(T), "must have the length 1; w comes first");
  file.check("matrix", is_rotation(T),
             "its left three columns must be a rotation: rows of length 1 at right angles, "
             "determinant +1");
}

}  // namespace sparsight
