#include "slam/odometry.h"

namespace sparsight {

struct Odometry::State {};

Odometry::Odometry(const RigCalibration&, const OdometryConfig&) {}
Odometry::~Odometry() = default;
FrameOutcome Odometry::track(const SynchronizedFrame&) { return {}; }
void Odometry::add_keyframe(const SynchronizedFrame&) {}
std::vector<RetiredKeyframe> Odometry::take_retired() { return {}; }
void Odometry::finish() {}

}  // namespace sparsight
