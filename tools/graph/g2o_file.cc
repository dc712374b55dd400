#include "tools/graph/g2o_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "tools/evaluation/number_lines.h"

namespace sparsight {
namespace {

constexpr std::string_view kVertex = "VERTEX_SE3:QUAT";
constexpr std::string_view kEdge = "EDGE_SE3:QUAT";
constexpr std::string_view kFix = "FIX";
constexpr std::size_t kPoseFields = 7;
constexpr std::size_t kInformationFields = 21;
constexpr std::size_t kShownField = 40;  // of a broken file's field
constexpr double kFarthest_m = 1e9;      // squares and their sums stay finite
constexpr double kMostInformation = 1e15;
constexpr double kUnitTolerance = 0.01;      // of a quaternion's length; files are rounded
constexpr double kNegativeTolerance = 1e-6;  // of an eigenvalue, as a share of the largest
constexpr std::int64_t kHighestId = std::numeric_limits<std::int64_t>::max() - 1;

class G2oParser {
 public:
  explicit G2oParser(const std::string& source) : source_(source) {}

  Result<G2oGraph> parse(std::string_view text) {
    const std::vector<NumberLine> lines = split_number_lines(text);
    for (const NumberLine& line : lines) {  // edges may stand before their vertices
      if (line.fields[0] == kVertex && !read_vertex(line)) return tl::unexpected(*error_);
    }
    for (const NumberLine& line : lines) {
      if (line.fields[0] != kVertex && !read_other(line)) return tl::unexpected(*error_);
    }
    if (file_.ids.empty()) {
      return fail(
          ErrorCode::kMissingField,
          fmt::format("{}: holds no {} line; is it a g2o file of 3D poses?", source_, kVertex));
    }
    return std::move(file_);
  }

 private:
  template <typename... Arguments>
  bool refuse(ErrorCode code, const NumberLine& line, fmt::format_string<Arguments...> text,
              Arguments&&... arguments) {
    error_ = Error{code, fmt::format("{}:{}: {}", source_, line.number,
                                     fmt::format(text, std::forward<Arguments>(arguments)...))};
    return false;
  }

  bool has_fields(const NumberLine& line, std::size_t count, const char* meaning) {
    if (line.fields.size() == count) return true;
    return refuse(ErrorCode::kWrongSize, line, "{} fields, but this line has {}: {}",
                  line.fields.size(), count, meaning);
  }

  bool read_id(const NumberLine& line, std::size_t field, std::int64_t& id) {
    const std::string_view text = line.fields[field];
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (error == std::errc{} && end == text.data() + text.size() && id >= 0 && id <= kHighestId) {
      return true;
    }
    return refuse(ErrorCode::kMalformed, line,
                  "field {} ('{}') is not a vertex id, a whole number from 0", field + 1,
                  text.substr(0, kShownField));
  }

  bool read_node(const NumberLine& line, std::size_t field, std::size_t& node) {
    std::int64_t id = 0;
    if (!read_id(line, field, id)) return false;
    const auto found = node_of_id_.find(id);
    if (found == node_of_id_.end()) {
      return refuse(ErrorCode::kMissingField, line, "there is no {} {}", kVertex, id);
    }
    node = found->second;
    return true;
  }

  bool read_number(const NumberLine& line, std::size_t field, double limit, double& value) {
    const Result<double> number = parse_number(line, field, source_);
    if (!number) {
      error_ = number.error();
      return false;
    }
    value = *number;
    if (std::abs(value) <= limit) return true;
    return refuse(ErrorCode::kOutOfRange, line, "field {} is {}; it must lie within +-{:g}",
                  field + 1, line.fields[field].substr(0, kShownField), limit);
  }

  bool read_pose(const NumberLine& line, std::size_t field, Eigen::Isometry3d& T) {
    std::array<double, kPoseFields> values{};
    for (std::size_t i = 0; i < kPoseFields; ++i) {
      if (!read_number(line, field + i, i < 3 ? kFarthest_m : 2.0, values[i])) return false;
    }
    const Eigen::Quaterniond q(values[6], values[3], values[4], values[5]);
    if (!(std::abs(q.norm() - 1.0) < kUnitTolerance)) {
      return refuse(
          ErrorCode::kOutOfRange, line,
          "fields {}-{} (qx qy qz qw) have length {:.3g}, but a rotation's quaternion has "
          "length 1",
          field + 4, field + 7, q.norm());
    }
    T = Eigen::Isometry3d::Identity();
    T.linear() = q.normalized().toRotationMatrix();
    T.translation() << values[0], values[1], values[2];
    return true;
  }

  bool read_information(const NumberLine& line, std::size_t field, Matrix6d& information) {
    for (int row = 0; row < 6; ++row) {
      for (int column = row; column < 6; ++column, ++field) {
        if (!read_number(line, field, kMostInformation, information(row, column))) return false;
        information(column, row) = information(row, column);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information, Eigen::EigenvaluesOnly);
    const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
    if (eigen.eigenvalues()(0) >= -kNegativeTolerance * largest) return true;
    return refuse(ErrorCode::kOutOfRange, line,
                  "fields {}-{} are no information matrix: it must have no negative eigenvalue",
                  field - kInformationFields + 1, field);
  }

  bool read_vertex(const NumberLine& line) {
    std::int64_t id = 0;
    Eigen::Isometry3d T;
    if (!has_fields(line, 2 + kPoseFields, "VERTEX_SE3:QUAT id x y z qx qy qz qw") ||
        !read_id(line, 1, id) || !read_pose(line, 2, T)) {
      return false;
    }
    if (!node_of_id_.emplace(id, file_.ids.size()).second) {
      return refuse(ErrorCode::kMalformed, line, "{} {} is there already", kVertex, id);
    }
    file_.ids.push_back(id);
    file_.graph.T_world_node.push_back(T);
    return true;
  }

  bool read_other(const NumberLine& line) {
    if (line.fields[0] == kEdge) return read_edge(line);
    if (line.fields[0] != kFix) {
      return refuse(ErrorCode::kMalformed, line, "'{}' is not one of {}, {}, {}",
                    line.fields[0].substr(0, kShownField), kVertex, kEdge, kFix);
    }
    for (std::size_t field = 1; field < line.fields.size(); ++field) {
      std::size_t node = 0;
      if (!read_node(line, field, node)) return false;
      if (std::ranges::find(file_.graph.held, node) == file_.graph.held.end()) {
        file_.graph.held.push_back(node);
      }
    }
    return true;
  }

  bool read_edge(const NumberLine& line) {
    PoseEdge edge;
    Matrix6d of_file = Matrix6d::Zero();
    if (!has_fields(line, 3 + kPoseFields + kInformationFields,
                    "EDGE_SE3:QUAT from to x y z qx qy qz qw and 21 of the information") ||
        !read_node(line, 1, edge.from) || !read_node(line, 2, edge.to) ||
        !read_pose(line, 3, edge.T_from_to) || !read_information(line, 3 + kPoseFields, of_file)) {
      return false;
    }
    if (edge.from == edge.to) {
      return refuse(ErrorCode::kOutOfRange, line, "an edge needs two vertices, not {} twice",
                    line.fields[1]);
    }
    edge.information = left_information(of_file, edge.T_from_to);
    const std::int64_t from = file_.ids[edge.from];
    const std::int64_t to = file_.ids[edge.to];
    const auto [first, second] = std::minmax(from, to);
    edge.loop = second - first != 1 || !steps_.insert(first).second;
    file_.graph.edges.push_back(edge);
    file_.edge_fields.push_back(fmt::format("{}", fmt::join(line.fields, " ")));
    return true;
  }

  // [x y z, rotation] of an increment on the right, to [rotation, x y z] of one on the left.
  static Matrix6d left_information(const Matrix6d& of_file, const Eigen::Isometry3d& T_from_to) {
    Matrix6d right;
    right << of_file.bottomRightCorner<3, 3>(), of_file.bottomLeftCorner<3, 3>(),
        of_file.topRightCorner<3, 3>(), of_file.topLeftCorner<3, 3>();
    const Matrix6d back = adjoint(T_from_to.inverse());
    return back.transpose() * right * back;
  }

  const std::string& source_;
  G2oGraph file_;
  std::unordered_map<std::int64_t, std::size_t> node_of_id_;
  std::unordered_set<std::int64_t> steps_;  // ids from which an edge to the next was read
  std::optional<Error> error_;
};

}  // namespace

Result<G2oGraph> parse_g2o(std::string_view text, const std::string& source) {
  return G2oParser(source).parse(text);
}

std::string format_g2o(const G2oGraph& file, const std::vector<std::size_t>& taken_out) {
  std::string text;
  for (std::size_t node = 0; node < file.ids.size(); ++node) {
    const Eigen::Isometry3d& T = file.graph.T_world_node[node];
    const Eigen::Quaterniond q(T.linear());
    text +=
        fmt::format("{} {} {} {} {} {} {} {} {}\n", kVertex, file.ids[node], T.translation().x(),
                    T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w());
  }
  for (const std::size_t node : file.graph.held) {
    text += fmt::format("{} {}\n", kFix, file.ids[node]);
  }
  for (std::size_t edge = 0; edge < file.edge_fields.size(); ++edge) {
    const bool out = std::ranges::binary_search(taken_out, edge);
    text += fmt::format("{}{}\n", out ? "# taken out: " : "", file.edge_fields[edge]);
  }
  return text;
}

}  // namespace sparsight
