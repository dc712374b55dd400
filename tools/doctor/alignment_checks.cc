#include "tools/doctor/alignment_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace sparsight {
namespace {

// A few of them meet an edge by chance.
constexpr std::size_t kEnoughEdges = 300;
// How much stronger the image must be at the best turn than around it. 1.15 to 1.6 are usual.
constexpr double kLeastContrast = 1.06;
// And how much stronger than as it is calibrated, to say that it is turned: where there are upright
// edges alone, nodding changes little. A turn by 1 deg made 7 to 17 % in five recordings.
constexpr double kLeastGain = 1.03;
constexpr double kWarnDeg = 0.45;
constexpr double kFailDeg = 0.7;

std::string turn_text(const Eigen::Vector3d& deg) {
  std::string text;
  const auto add = [&](double angle, const char* positive, const char* negative) {
    if (angle == 0.0) return;
    text += fmt::format("{}{:.2f} deg {}", text.empty() ? "" : " and ", std::abs(angle),
                        angle > 0.0 ? positive : negative);
  };
  add(deg.x(), "upwards", "downwards");
  add(deg.y(), "to the right", "to the left");
  add(deg.z(), "clockwise", "anticlockwise");
  return text;
}

}  // namespace

Check alignment_check(const EdgeAlignmentReport& seen, const std::string& overlay) {
  Check check{"lidar on image", Verdict::kOk, "", ""};
  check.figures = {{"frames", static_cast<double>(seen.frames)},
                   {"depth_edges", static_cast<double>(seen.edges)}};
  if (seen.edges < kEnoughEdges) {
    check.verdict = Verdict::kWarn;
    check.found =
        fmt::format("cannot be told from {} depth edges in {} frames", seen.edges, seen.frames);
    check.fix =
        "point the rig at things with nothing close behind them, such as posts and door frames, "
        "and watch for longer";
    return check;
  }
  const double off_deg = seen.best_turn_deg.norm();
  check.figures.insert(check.figures.end(), {{"share_of_turns_worse", seen.share_worse},
                                             {"gradient", seen.gradient},
                                             {"turned_gradient", seen.turned_gradient},
                                             {"best_turn_x_deg", seen.best_turn_deg.x()},
                                             {"best_turn_y_deg", seen.best_turn_deg.y()},
                                             {"best_turn_z_deg", seen.best_turn_deg.z()}});
  check.found = fmt::format(
      "{:.0f} % of turns by about 1 deg are worse, the image is {:.2f} times as "
      "strong at depth edges as then",
      100.0 * seen.share_worse, seen.gradient / seen.turned_gradient);
  if (!overlay.empty()) check.found += "; see " + overlay;
  if (seen.best_gradient < kLeastContrast * seen.turned_gradient) {
    check.verdict = Verdict::kWarn;
    check.fix = "the images hardly tell: try where things stand out against what is behind them";
  } else if (off_deg >= kWarnDeg && seen.best_gradient >= kLeastGain * seen.gradient) {
    check.verdict = off_deg >= kFailDeg ? Verdict::kFail : Verdict::kWarn;
    check.fix = fmt::format(
        "it fits best with what the LiDAR sees turned {} in the image: calibrate "
        "[calibration.T_camera_lidar] again, and see whether the mount has moved",
        turn_text(seen.best_turn_deg));
  }
  return check;
}

}  // namespace sparsight
