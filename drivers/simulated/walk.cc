#include "drivers/simulated/walk.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "drivers/simulated/random.h"

namespace sparsight::simulated {
namespace {

constexpr double kSpacingM = 0.4;  // between the controls of the way
constexpr double kStrideM = 1.30;  // two steps
constexpr double kDegree = M_PI / 180.0;

// 0 to 1 with two vanishing derivatives at both ends, and its integral.
double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (x * (x * 6.0 - 15.0) + 10.0);
}

double smooth_step_integral(double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return x - 0.5;
  return x * x * x * x * (x * (x - 3.0) + 2.5);
}

// The polygon with an arc (quadratic Bézier) at each corner, as points a centimetre apart.
std::vector<Eigen::Vector2d> rounded(const WalkPlan& plan) {
  std::vector<Eigen::Vector2d> points;
  const std::size_t n = plan.corners.size();
  const auto line = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int steps = std::max(1, static_cast<int>((to - from).norm() / 0.01));
    for (int i = 0; i < steps; ++i) points.push_back(from + (to - from) * i / steps);
  };
  Eigen::Vector2d at = 0.5 * (plan.corners[0] + plan.corners[1]);
  const Eigen::Vector2d start = at;
  for (std::size_t i = 1; i <= n; ++i) {
    const Eigen::Vector2d& corner = plan.corners[i % n];
    const Eigen::Vector2d& next = plan.corners[(i + 1) % n];
    const Eigen::Vector2d in = corner + plan.corner_m * (at - corner).normalized();
    const Eigen::Vector2d out = corner + plan.corner_m * (next - corner).normalized();
    line(at, in);
    for (int k = 0; k < 150; ++k) {
      const double s = k / 150.0;
      points.emplace_back((1 - s) * (1 - s) * in + 2 * s * (1 - s) * corner + s * s * out);
    }
    at = out;
  }
  line(at, start);
  return points;
}

double length_of(const std::vector<Eigen::Vector2d>& loop) {
  double length = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
  }
  return length;
}

std::vector<Eigen::Vector2d> even(const std::vector<Eigen::Vector2d>& loop, std::size_t count,
                                  double length) {
  std::vector<Eigen::Vector2d> out;
  double passed = 0.0;
  for (std::size_t i = 0; i < loop.size() && out.size() < count; ++i) {
    const Eigen::Vector2d step = loop[(i + 1) % loop.size()] - loop[i];
    const double target = length * static_cast<double>(out.size()) / static_cast<double>(count);
    if (passed + step.norm() > target) {
      out.emplace_back(loop[i] + step * (target - passed) / step.norm());
    }
    passed += step.norm();
  }
  return out;
}

}  // namespace

double SmoothLoop::control(std::int64_t index) const {
  const auto n = static_cast<std::int64_t>(controls_.size());
  const std::int64_t lap = (index >= 0 ? index : index - n + 1) / n;
  return controls_[static_cast<std::size_t>(index - lap * n)] + gain_ * static_cast<double>(lap);
}

double SmoothLoop::operator()(double laps) const {
  const double at = laps * static_cast<double>(controls_.size());
  const double whole = std::floor(at);
  const auto i = static_cast<std::int64_t>(whole);
  const double t = at - whole;
  const double u = 1.0 - t;
  return (u * u * u * control(i - 1) + (3 * t * t * t - 6 * t * t + 4) * control(i) +
          (3 * u * u * u - 6 * u * u + 4) * control(i + 1) + t * t * t * control(i + 2)) /
         6.0;
}

Walk::Walk(const WalkPlan& plan, std::uint64_t seed, std::vector<SimulatedFaults::Carried> carried)
    : plan_(plan), seed_(seed), carried_(std::move(carried)) {
  const std::vector<Eigen::Vector2d> way = rounded(plan);
  const double length = length_of(way);
  const auto count = static_cast<std::size_t>(length / kSpacingM);
  const std::vector<Eigen::Vector2d> controls = even(way, count, length);
  lap_m_ = length;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> heading;
  const std::size_t n = controls.size();
  for (std::size_t i = 0; i < n; ++i) {
    x.push_back(controls[i].x());
    y.push_back(controls[i].y());
    // Eyes lead the feet into a turn: the heading is that of the way half a metre ahead.
    const Eigen::Vector2d ahead = controls[(i + 3) % n] - controls[i];
    const double angle = std::atan2(ahead.y(), ahead.x());
    const double last = heading.empty() ? angle : heading.back();
    heading.push_back(last + std::remainder(angle - last, 2.0 * M_PI));
  }
  const double turn =
      heading.back() - heading.front() + std::remainder(heading.front() - heading.back(), 2 * M_PI);
  x_ = SmoothLoop(std::move(x), 0.0);
  y_ = SmoothLoop(std::move(y), 0.0);
  heading_ = SmoothLoop(std::move(heading), turn);

  Random random(seed, 0x3a1c);
  // Metres along x, y, z; radians of yaw, pitch, roll.
  const std::array<double, 6> amplitude{0.020,         0.025,         0.018,
                                        5.0 * kDegree, 3.0 * kDegree, 1.6 * kDegree};
  for (std::size_t channel = 0; channel < wanders_.size(); ++channel) {
    for (std::size_t k = 0; k < wanders_[channel].size(); ++k) {
      const double hz = random.uniform(0.08, 0.16) * std::pow(2.1, static_cast<double>(k));
      wanders_[channel][k] = {2.0 * M_PI * hz, random.uniform(0.0, 2.0 * M_PI),
                              amplitude[channel] / std::pow(1.7, static_cast<double>(k))};
    }
  }
}

// Which second of the walk it is.
double Walk::on_the_walk(double seconds) const {
  double on_the_walk = seconds;
  for (const SimulatedFaults::Carried& carried : carried_) {
    if (seconds >= to_seconds(carried.at)) on_the_walk += to_seconds(carried.ahead);
  }
  return on_the_walk;
}

double Walk::walked_m(double seconds) const {
  const double since = (seconds - plan_.rest_s) / plan_.ramp_s;
  const double even = plan_.speed_m_s * plan_.ramp_s * smooth_step_integral(since);
  // Nobody keeps an even pace.
  return even + 0.10 * smooth_step(since) * std::sin(0.83 * seconds + wanders_[0][0].phase);
}

// To one side and back within three seconds, not before the walk is under way.
double Walk::look(double seconds) const {
  constexpr double kDurationS = 3.0;
  const double number = std::floor(seconds / plan_.look_every_s);
  if (number < 0.0) return 0.0;
  Random random(seed_, 0x100c, static_cast<std::uint64_t>(number));
  const double begin =
      number * plan_.look_every_s + random.uniform(2.5, plan_.look_every_s - kDurationS);
  const double yaw = plan_.look_yaw_deg * kDegree * random.uniform(0.4, 1.0);
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  const double phase = (seconds - begin) / kDurationS;
  if (phase <= 0.0 || phase >= 1.0) return 0.0;
  const double bump = 0.5 * (1.0 - std::cos(2.0 * M_PI * phase));
  return side * yaw * bump * bump;
}

double Walk::wander(const Wander& waves, double seconds) const {
  double sum = 0.0;
  for (const Wave& wave : waves) {
    sum += wave.amplitude * std::sin(wave.radians_per_s * seconds + wave.phase);
  }
  return sum;
}

Eigen::Isometry3d Walk::lidar_pose(double at) const {
  const double seconds = on_the_walk(at);
  const double walked = walked_m(seconds);
  const double laps = (plan_.start_m + walked) / lap_m_;
  // At rest a hand still moves a little.
  const double gait = smooth_step((seconds - plan_.rest_s) / plan_.ramp_s);
  const double hand = 0.15 + 0.85 * gait;
  const double step = 2.0 * M_PI * walked / kStrideM;
  const double tremor = 0.0006 * std::sin(2.0 * M_PI * 6.3 * seconds + wanders_[1][0].phase);

  const Eigen::Vector3d offset(
      hand * wander(wanders_[0], seconds) + gait * 0.008 * std::sin(2.0 * step + 0.8),
      hand * wander(wanders_[1], seconds) + gait * 0.022 * std::sin(step),
      hand * wander(wanders_[2], seconds) - gait * 0.019 * std::cos(2.0 * step));
  const double yaw = heading_(laps) + look(seconds) + hand * wander(wanders_[3], seconds) +
                     gait * 1.2 * kDegree * std::sin(step + 0.7) + tremor;
  const double pitch = hand * wander(wanders_[4], seconds) +
                       gait * 0.7 * kDegree * std::sin(2.0 * step + 2.0) - 0.6 * tremor;
  const double roll = hand * wander(wanders_[5], seconds) +
                      gait * 0.9 * kDegree * std::sin(step + 2.4) + 0.8 * tremor;

  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const Eigen::AngleAxisd heading(heading_(laps), Eigen::Vector3d::UnitZ());
  T.translation() = Eigen::Vector3d(x_(laps), y_(laps), plan_.height_m) + heading * offset;
  T.linear() = (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

}  // namespace sparsight::simulated
