#include "slam/loop/loop_closer.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <utility>

#include "slam/loop/integrated_depth.h"

namespace sparsight {
namespace {

constexpr std::size_t kMatchesPerQuery = 10;
constexpr int kQuestionsPerKeyframe = 2;   // of those that had to wait, one a keyframe
constexpr std::size_t kMostPoints = 3000;  // of a keyframe's cloud
// Of a step whose tracking failed: not a tenth of a turn, not ten metres.
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
  // All that is kept in memory of a keyframe, some 15 KB with what database and graph know of it:
  // nearly all of it its words. Features are found again when they are asked for.
  struct Place {
    std::uint64_t sequence = 0;
    Eigen::Isometry3d T_odometry_camera = Eigen::Isometry3d::Identity();
    CameraIntrinsics camera;  // at the level of the image
    BagOfWords bag;
    std::size_t stored = 0;  // its image and cloud
  };

  State(const OdometryConfig& settings, std::shared_ptr<const Vocabulary> words,
        std::shared_ptr<KeyframeStore> bulk)
      : odometry(settings),
        config(settings.loop),
        vocabulary(std::move(words)),
        store(std::move(bulk)),
        database(vocabulary->words()),
        filter(config.consistent_queries),
        graph(config.dcs_phi) {}

  OdometryConfig odometry;
  LoopConfig config;
  std::shared_ptr<const Vocabulary> vocabulary;
  std::shared_ptr<KeyframeStore> store;
  PlaceDatabase database;
  CandidateFilter filter;
  LoopGraph graph;
  std::vector<Place> places;
  std::optional<RetiredKeyframe::Successor> to_next;  // of the last place
  std::size_t asked = 0;                              // places that were asked about
  std::vector<LoopClosure> found;                     // also those taken out since
  LoopStatistics statistics;

  void remember(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera);
  bool ask(std::size_t index);
  bool verify(std::size_t index, std::size_t candidate);
  double similarity_with_neighbours(std::size_t index) const;
  LoopView view_of(std::size_t index) const;
};

void LoopCloser::State::remember(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera) {
  const int level = std::min(config.image_level, keyframe.pyramid.levels() - 1);
  Place place{.sequence = keyframe.sequence,
              .T_odometry_camera = keyframe.T_world_camera,
              .camera = CameraModel(camera).at_level(level).intrinsics()};
  const GreyImage& image = keyframe.pyramid.level(level);
  const OrbFeatures features = orb_features(image, {.features = config.features});
  place.bag = vocabulary->bag_of(features.descriptors);
  place.bag.shrink_to_fit();
  place.stored = store->put({.image = image, .cloud_camera = keyframe.cloud_camera});
  database.add(place.bag);
  if (places.empty()) {
    graph.add_first(keyframe.T_world_camera);
  } else {
    const Eigen::Isometry3d T_last_next =
        places.back().T_odometry_camera.inverse() * keyframe.T_world_camera;
    const bool known = to_next && to_next->sequence == keyframe.sequence && !keyframe.predicted;
    graph.add_next(T_last_next, believable(known ? to_next->information : Matrix6d::Zero(),
                                           T_last_next.translation().norm(), config));
  }
  to_next = keyframe.successor;
  places.push_back(std::move(place));
  ++statistics.keyframes;
}

double LoopCloser::State::similarity_with_neighbours(std::size_t index) const {
  const auto reach = static_cast<std::size_t>(config.neighbours);
  double least = 1.0;
  for (std::size_t other = index - std::min(index, reach);
       other <= std::min(index + reach, places.size() - 1); ++other) {
    if (other != index) least = std::min(least, similarity(places[index].bag, places[other].bag));
  }
  return least;
}

LoopView LoopCloser::State::view_of(std::size_t index) const {
  const auto reach = static_cast<std::size_t>(config.neighbours);
  const Place& place = places[index];
  LoopView view;
  std::vector<std::vector<Eigen::Vector3f>> points;
  std::vector<NearbyCloud> clouds;
  for (std::size_t other = index - std::min(index, reach);
       other <= std::min(index + reach, places.size() - 1); ++other) {
    auto bulk = store->get(places[other].stored);
    if (!bulk) continue;
    points.push_back(thinned_cloud(bulk->cloud_camera));
    clouds.push_back(
        {place.T_odometry_camera.inverse() * places[other].T_odometry_camera, points.back()});
    if (other == index) view.image = std::move(bulk->image);
  }
  view.returns = integrated_depth(clouds, CameraModel(place.camera));
  view.features = orb_features(view.image, {.features = config.features});
  return view;
}

bool LoopCloser::State::verify(std::size_t index, std::size_t candidate) {
  ++statistics.candidates;
  LoopVerifier verifier(CameraModel(places[index].camera), config.verification, odometry.points,
                        odometry.tracker, odometry.photometry);
  const LoopCheck check = verifier.check(view_of(index), view_of(candidate));
  ++statistics.verdicts[check.verdict];
  if (check.verdict != LoopCheck::Verdict::kAccepted) return false;
  if (!graph.add_loop(index, candidate, check.T_current_candidate, check.information)) {
    ++statistics.contradicted;
    return false;
  }
  found.push_back(
      {.candidate = places[candidate].sequence, .current = places[index].sequence, .check = check});
  return true;
}

bool LoopCloser::State::ask(std::size_t index) {
  const auto recent = static_cast<std::size_t>(config.recent_keyframes);
  const std::size_t end = index > recent ? index - recent : 0;
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

LoopCloser::LoopCloser(const OdometryConfig& config, std::shared_ptr<const Vocabulary> vocabulary,
                       std::shared_ptr<KeyframeStore> store)
    : state_(std::make_unique<State>(
          config, std::move(vocabulary),
          store ? std::move(store) : std::make_shared<MemoryKeyframeStore>())) {}

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

std::vector<PlacedKeyframe> LoopCloser::placed() const {
  const State& s = *state_;
  const bool as_odometry = s.found.empty();  // to the last digit
  std::vector<PlacedKeyframe> result;
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    const State::Place& place = s.places[i];
    result.push_back({place.sequence, place.stored, place.camera,
                      as_odometry ? place.T_odometry_camera : s.graph.graph().T_world_node[i]});
  }
  return result;
}

std::map<std::uint64_t, Eigen::Isometry3d> LoopCloser::poses() const {
  std::map<std::uint64_t, Eigen::Isometry3d> result;
  for (const PlacedKeyframe& keyframe : placed()) {
    result[keyframe.sequence] = keyframe.T_world_camera;
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
