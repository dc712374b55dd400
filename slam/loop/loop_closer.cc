#include "slam/loop/loop_closer.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <utility>

#include "slam/loop/integrated_depth.h"
#include "slam/loop/join_evidence.h"

namespace sparsight {
namespace {

constexpr std::size_t kMatchesPerQuery = 10;
constexpr int kQuestionsPerKeyframe = 2;   // of those that had to wait, one a keyframe
constexpr std::size_t kMostPoints = 3000;  // of a keyframe's cloud
// Of a step of which nothing is known: not a tenth of a turn, not ten metres.
constexpr double kBoundRad = 0.5;
constexpr double kBoundM = 10.0;

std::vector<Eigen::Vector3f> thinned_cloud(const std::vector<CloudPoint>& cloud) {
  const std::size_t step = 1 + cloud.size() / kMostPoints;
  std::vector<Eigen::Vector3f> result;
  for (std::size_t i = 0; i < cloud.size(); i += step) result.push_back(cloud[i].p_camera);
  return result;
}

// Odometry's own information, never beyond what its calibration allows to believe, and never
// nothing.
Matrix6d believable(const Matrix6d& information, double step_m, const LoopConfig& config) {
  Vector6d bound;
  bound << Eigen::Vector3d::Constant(kBoundRad), Eigen::Vector3d::Constant(kBoundM);
  Matrix6d bounded = information;
  bounded.diagonal() += bound.cwiseAbs2().cwiseInverse();
  Vector6d floor;
  floor << Eigen::Vector3d::Constant(config.odometry_floor_deg * M_PI / 180.0),
      Eigen::Vector3d::Constant(config.odometry_floor_m + config.odometry_floor_share * step_m);
  Matrix6d covariance = bounded.inverse();
  covariance.diagonal() += floor.cwiseAbs2();
  const Matrix6d believed = covariance.inverse();
  return 0.5 * (believed + believed.transpose());
}

}  // namespace

struct LoopCloser::State {
  // All that is kept of a keyframe: 160 KB of an image of 800 x 600, three quarters of it the
  // image. Features are found again when they are asked for.
  struct Place {
    std::uint64_t sequence = 0;
    std::size_t submap = 0;  // the first place of its sub-map
    Eigen::Isometry3d T_odometry_camera = Eigen::Isometry3d::Identity();
    CameraIntrinsics camera;  // at the level of the image
    GreyImage image;
    BagOfWords bag;
    std::vector<Eigen::Vector3f> cloud_camera;
  };

  State(const OdometryConfig& settings, std::shared_ptr<const Vocabulary> words)
      : odometry(settings),
        config(settings.loop),
        vocabulary(std::move(words)),
        database(vocabulary->words()),
        filter(config.consistent_queries),
        graph(config.dcs_phi),
        evidence(config.join) {}

  OdometryConfig odometry;
  LoopConfig config;
  std::shared_ptr<const Vocabulary> vocabulary;
  PlaceDatabase database;
  CandidateFilter filter;
  LoopGraph graph;
  JoinEvidence evidence;  // for sub-maps that nothing connects
  std::vector<Place> places;
  std::optional<RetiredKeyframe::Successor> to_next;  // of the last place
  std::size_t asked = 0;                              // places that were asked about
  std::vector<LoopClosure> found;                     // also those taken out since
  LoopStatistics statistics;

  void remember(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera);
  bool ask(std::size_t index);
  bool verify(std::size_t index, std::size_t candidate);
  bool believe(const SeenAgain& loop);
  bool join(const SeenAgain& loop);
  bool continues(const RetiredKeyframe& keyframe) const;
  void put_in_graph(const RetiredKeyframe& keyframe, bool begins_submap);
  void keep(const SeenAgain& loop);
  std::pair<std::size_t, std::size_t> neighbourhood(std::size_t index) const;
  double similarity_with_neighbours(std::size_t index) const;
  LoopView view_of(std::size_t index) const;
};

void LoopCloser::State::remember(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera) {
  const int level = std::min(config.image_level, keyframe.pyramid.levels() - 1);
  Place place{.sequence = keyframe.sequence,
              .T_odometry_camera = keyframe.T_world_camera,
              .camera = CameraModel(camera).at_level(level).intrinsics(),
              .image = keyframe.pyramid.level(level),
              .cloud_camera = thinned_cloud(keyframe.cloud_camera)};
  const OrbFeatures features = orb_features(place.image, {.features = config.features});
  place.bag = vocabulary->bag_of(features.descriptors);
  database.add(place.bag);
  place.submap = continues(keyframe) ? places.back().submap : places.size();
  put_in_graph(keyframe, place.submap == places.size());
  to_next = keyframe.successor;
  places.push_back(std::move(place));
  ++statistics.keyframes;
}

// Whether odometry measured where it stands relative to the keyframe before: if that names it as
// the next, and tracking had not lost its way between them. What does not continue begins a
// sub-map.
bool LoopCloser::State::continues(const RetiredKeyframe& keyframe) const {
  return to_next && to_next->sequence == keyframe.sequence && !keyframe.predicted;
}

void LoopCloser::State::put_in_graph(const RetiredKeyframe& keyframe, bool begins_submap) {
  if (places.empty()) {
    graph.begin_submap(keyframe.T_world_camera);
    return;
  }
  const Eigen::Isometry3d T_last_next =
      places.back().T_odometry_camera.inverse() * keyframe.T_world_camera;
  if (begins_submap) {  // by the odometry's guess, until something better is known
    graph.begin_submap(renormalized(graph.graph().T_world_node.back() * T_last_next));
    return;
  }
  graph.add_next(T_last_next,
                 believable(to_next->information, T_last_next.translation().norm(), config));
}

// The places on either side that odometry connects it with: from the first to the last.
std::pair<std::size_t, std::size_t> LoopCloser::State::neighbourhood(std::size_t index) const {
  const auto reach = static_cast<std::size_t>(config.neighbours);
  const std::size_t first = std::max(places[index].submap, index - std::min(index, reach));
  std::size_t last = std::min(index + reach, places.size() - 1);
  while (places[last].submap != places[index].submap) --last;
  return {first, last};
}

double LoopCloser::State::similarity_with_neighbours(std::size_t index) const {
  double least = 1.0;
  const auto [first, last] = neighbourhood(index);
  for (std::size_t other = first; other <= last; ++other) {
    if (other != index) least = std::min(least, similarity(places[index].bag, places[other].bag));
  }
  return least;
}

LoopView LoopCloser::State::view_of(std::size_t index) const {
  const Place& place = places[index];
  std::vector<NearbyCloud> clouds;
  const auto [first, last] = neighbourhood(index);
  for (std::size_t other = first; other <= last; ++other) {
    clouds.push_back({place.T_odometry_camera.inverse() * places[other].T_odometry_camera,
                      places[other].cloud_camera});
  }
  return {.image = place.image,
          .returns = integrated_depth(clouds, CameraModel(place.camera)),
          .features = orb_features(place.image, {.features = config.features})};
}

bool LoopCloser::State::verify(std::size_t index, std::size_t candidate) {
  ++statistics.candidates;
  LoopVerifier verifier(CameraModel(places[index].camera), config.verification, odometry.points,
                        odometry.tracker, odometry.photometry);
  const LoopCheck check = verifier.check(view_of(index), view_of(candidate));
  ++statistics.verdicts[check.verdict];
  if (check.verdict != LoopCheck::Verdict::kAccepted) return false;
  const SeenAgain loop{.current = index, .candidate = candidate, .check = check};
  return graph.connected(index, candidate) ? believe(loop) : join(loop);
}

// Between keyframes that are connected already.
bool LoopCloser::State::believe(const SeenAgain& loop) {
  if (!graph.add_loop(loop.current, loop.candidate, loop.check.T_current_candidate,
                      loop.check.information)) {
    ++statistics.contradicted;
    return false;
  }
  keep(loop);
  return true;
}

// Between sub-maps that nothing connects.
bool LoopCloser::State::join(const SeenAgain& loop) {
  const std::vector<SeenAgain> agreeing = evidence.add(loop, graph);
  if (agreeing.empty()) return false;
  std::vector<PoseEdge> edges;
  for (const SeenAgain& one : agreeing) edges.push_back(one.edge());
  if (!graph.join(edges)) return false;
  ++statistics.submaps_joined;
  for (const SeenAgain& one : agreeing) keep(one);
  evidence.drop_connected(graph);
  return true;
}

void LoopCloser::State::keep(const SeenAgain& loop) {
  found.push_back({.candidate = places[loop.candidate].sequence,
                   .current = places[loop.current].sequence,
                   .check = loop.check});
}

bool LoopCloser::State::ask(std::size_t index) {
  const auto recent = static_cast<std::size_t>(config.recent_keyframes);
  // However recent: no odometry leads to the sub-maps before.
  const std::size_t end = std::max(places[index].submap, index - std::min(index, recent));
  const std::vector<PlaceMatch> matches =
      database.query(places[index].bag, end, similarity_with_neighbours(index), kMatchesPerQuery);
  if (!matches.empty()) ++statistics.queries;
  int checks = 0;
  for (const std::uint32_t candidate : filter.next(matches)) {
    if (checks++ == config.checks_per_keyframe) break;
    if (verify(index, candidate)) return true;
  }
  return false;
}

LoopCloser::LoopCloser(const OdometryConfig& config, std::shared_ptr<const Vocabulary> vocabulary)
    : state_(std::make_unique<State>(config, std::move(vocabulary))) {}

LoopCloser::~LoopCloser() = default;

bool LoopCloser::add(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera, bool search) {
  State& s = *state_;
  if (keyframe.pyramid.empty()) return false;
  s.remember(keyframe, camera);
  const auto delay = static_cast<std::size_t>(s.config.neighbours);
  bool moved = false;
  for (int i = 0; search && i < kQuestionsPerKeyframe && s.places.size() > s.asked + delay; ++i) {
    moved = s.ask(s.asked++) || moved;
  }
  return moved;
}

bool LoopCloser::finish() {
  State& s = *state_;
  bool moved = false;
  while (s.asked < s.places.size()) moved = s.ask(s.asked++) || moved;
  return moved;
}

std::map<std::uint64_t, Eigen::Isometry3d> LoopCloser::poses() const {
  const State& s = *state_;
  const bool as_odometry = s.found.empty();  // to the last digit
  std::map<std::uint64_t, Eigen::Isometry3d> result;
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    result[s.places[i].sequence] =
        as_odometry ? s.places[i].T_odometry_camera : s.graph.graph().T_world_node[i];
  }
  return result;
}

std::vector<Submap> LoopCloser::submaps() const {
  const State& s = *state_;
  std::vector<Submap> result;
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    if (s.places[i].submap == i) result.push_back({.first_keyframe = s.places[i].sequence});
    ++result.back().keyframes;
    const std::size_t oldest = s.graph.part_of(i);
    result.back().part = s.places[s.places[oldest].submap].sequence;
  }
  return result;
}

std::vector<LoopClosure> LoopCloser::loops() const {
  const State& s = *state_;
  std::vector<LoopClosure> standing;
  for (const LoopClosure& loop : s.found) {
    const bool stands = std::ranges::any_of(s.graph.graph().edges, [&](const PoseEdge& edge) {
      return edge.loop && s.places[edge.from].sequence == loop.current &&
             s.places[edge.to].sequence == loop.candidate;
    });
    if (stands) standing.push_back(loop);
  }
  return standing;
}

const LoopStatistics& LoopCloser::statistics() const { return state_->statistics; }

}  // namespace sparsight
