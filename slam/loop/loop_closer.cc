#include "slam/loop/loop_closer.h"

#include <Eigen/LU>
#include <algorithm>
#include <optional>
#include <utility>

#include "slam/loop/integrated_depth.h"
#include "slam/loop/join_doubts.h"
#include "slam/loop/join_evidence.h"
#include "slam/loop/place_image.h"

namespace sparsight {
namespace {

constexpr std::size_t kMatchesPerQuery = 10;
constexpr int kQuestionsPerKeyframe = 2;  // of those that had to wait, one a keyframe
constexpr int kChecksAtOnce = 4;
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
  // All that is kept in memory of a keyframe, some 15 KB with what database and graph know of it:
  // nearly all of it its words. Features are found again when they are asked for.
  struct Place {
    std::uint32_t session = 0;
    std::uint64_t sequence = 0;
    std::size_t submap = 0;  // the first place of its sub-map
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
        graph(config.dcs_phi),
        evidence(config.join),
        doubts(config.join) {}

  OdometryConfig odometry;
  LoopConfig config;
  std::shared_ptr<const Vocabulary> vocabulary;
  std::shared_ptr<KeyframeStore> store;
  PlaceDatabase database;
  CandidateFilter filter;
  LoopGraph graph;
  JoinEvidence evidence;  // for sub-maps that nothing connects
  JoinDoubts doubts;      // about those that loops have joined
  std::vector<Place> places;
  std::size_t earlier = 0;                            // the first of them are an earlier map's
  std::uint32_t session = 0;                          // this one
  std::optional<RetiredKeyframe::Successor> to_next;  // of the last place
  std::size_t asked = 0;                              // places that were asked about
  std::vector<SeenAgain> found;                       // also those taken out since
  LoopStatistics statistics;

  void remember(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera);
  bool ask(std::size_t index);
  bool ask_at_once(std::size_t index);
  bool adrift() const;
  bool verify_some(std::size_t index, const std::vector<std::uint32_t>& candidates,
                   int most_checks);
  bool verify(std::size_t index, const LoopView& view, std::size_t candidate);
  bool believe(const SeenAgain& loop);
  bool join(const SeenAgain& loop);
  bool continues(const RetiredKeyframe& keyframe) const;
  void put_in_graph(const RetiredKeyframe& keyframe, bool begins_submap);
  bool in_earlier_map(std::size_t index) const;
  bool reaches(std::size_t part) const;
  std::pair<std::size_t, std::size_t> neighbourhood(std::size_t index) const;
  double similarity_with_neighbours(std::size_t index) const;
  LoopView view_of(std::size_t index) const;
};

void LoopCloser::State::remember(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera) {
  const int level =
      place_image_level(std::min(config.image_level, keyframe.pyramid.levels() - 1), camera.width);
  Place place{.session = session,
              .sequence = keyframe.sequence,
              .T_odometry_camera = keyframe.T_world_camera,
              .camera = CameraModel(camera).at_level(level).intrinsics()};
  const GreyImage& image = keyframe.pyramid.level(level);
  const OrbFeatures features = orb_features(image, {.features = config.features});
  place.bag = vocabulary->bag_of(features.descriptors);
  place.bag.shrink_to_fit();
  place.stored = store->put({.image = image, .cloud_camera = keyframe.cloud_camera});
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
  return to_next && to_next->sequence == keyframe.sequence && !keyframe.begins_submap;
}

void LoopCloser::State::put_in_graph(const RetiredKeyframe& keyframe, bool begins_submap) {
  if (places.size() == earlier) {
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
  LoopView view;
  std::vector<std::vector<Eigen::Vector3f>> points;
  std::vector<NearbyCloud> clouds;
  const auto [first, last] = neighbourhood(index);
  for (std::size_t other = first; other <= last; ++other) {
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

bool LoopCloser::State::verify(std::size_t index, const LoopView& view, std::size_t candidate) {
  ++statistics.candidates;
  LoopVerifier verifier(CameraModel(places[index].camera), config.verification, odometry.points,
                        odometry.tracker, odometry.photometry);
  const LoopCheck check = verifier.check(view, view_of(candidate));
  ++statistics.verdicts[check.verdict];
  if (check.verdict != LoopCheck::Verdict::kAccepted) return false;
  const SeenAgain loop{.current = index, .candidate = candidate, .check = check};
  return graph.connected(index, candidate) ? believe(loop) : join(loop);
}

// Between keyframes that are connected already.
bool LoopCloser::State::believe(const SeenAgain& loop) {
  if (graph.add_loop(loop.current, loop.candidate, loop.check.T_current_candidate,
                     loop.check.information)) {
    found.push_back(loop);
    return true;
  }
  ++statistics.contradicted;
  auto revised = doubts.add(loop, graph, [this](std::size_t i) { return places[i].submap; });
  if (!revised) return false;
  graph = std::move(revised->graph);
  found.insert(found.end(), revised->loops.begin(), revised->loops.end());
  ++statistics.joins_revised;
  return true;
}

// Between sub-maps that nothing connects.
bool LoopCloser::State::join(const SeenAgain& loop) {
  const std::vector<SeenAgain> agreeing = evidence.add(loop, graph);
  if (agreeing.empty()) return false;
  std::vector<PoseEdge> edges;
  edges.reserve(agreeing.size());
  for (const SeenAgain& one : agreeing) edges.push_back(one.edge());
  if (!graph.join(edges)) return false;
  ++statistics.submaps_joined;
  found.insert(found.end(), agreeing.begin(), agreeing.end());
  evidence.drop_connected(graph);
  return true;
}

// Whether its pose is in the frame of the earlier map: one of its own, or joined to it.
bool LoopCloser::State::in_earlier_map(std::size_t index) const {
  return graph.part_of(index) < earlier;
}

// Whether a keyframe of this session is in the part.
bool LoopCloser::State::reaches(std::size_t part) const {
  for (std::size_t i = earlier; i < places.size(); ++i) {
    if (graph.part_of(i) == part) return true;
  }
  return false;
}

bool LoopCloser::State::ask(std::size_t index) {
  const auto recent = static_cast<std::size_t>(config.recent_keyframes);
  // However recent: no odometry leads to the sub-maps before.
  const std::size_t end = std::max(places[index].submap, index - std::min(index, recent));
  const std::vector<PlaceMatch> matches =
      database.query(places[index].bag, end, similarity_with_neighbours(index), kMatchesPerQuery);
  if (!matches.empty()) ++statistics.queries;
  return verify_some(index, filter.next(matches), config.checks_per_keyframe);
}

// Where the sub-map stands is wanted soon: the newest keyframe is asked about with the depth of
// those before it alone, and what is most similar is verified, whether or not it was the same place
// before. That a single image finds look-alikes is JoinEvidence's to find out.
bool LoopCloser::State::ask_at_once(std::size_t index) {
  std::vector<std::uint32_t> candidates;
  for (const PlaceMatch& match :
       database.query(places[index].bag, places[index].submap, 0.0, kMatchesPerQuery)) {
    const bool beside_another = std::ranges::any_of(candidates, [&](std::uint32_t other) {
      return std::max(other, match.place) - std::min(other, match.place) <= 1;
    });
    if (!beside_another) candidates.push_back(match.place);
  }
  return verify_some(index, candidates, kChecksAtOnce);
}

// Whether nobody knows where the newest keyframe's sub-map stands.
bool LoopCloser::State::adrift() const {
  const std::size_t submap = places.back().submap;
  return submap > 0 && graph.part_of(submap) == submap;
}

bool LoopCloser::State::verify_some(std::size_t index, const std::vector<std::uint32_t>& candidates,
                                    int most_checks) {
  int checks = 0;
  std::optional<LoopView> view;
  for (const std::uint32_t candidate : candidates) {
    const bool known = std::ranges::any_of(found, [&](const SeenAgain& loop) {
      return loop.current == index && loop.candidate == candidate;
    });
    if (known) continue;  // asked about again, with more depth
    if (checks++ == most_checks) break;
    if (!view) view = view_of(index);
    if (verify(index, *view, candidate)) return true;
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
  bool moved = search && s.adrift() && s.ask_at_once(s.places.size() - 1);
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

void LoopCloser::resume(KnownPlaces earlier) {
  State& s = *state_;
  PoseGraph graph{.edges = std::move(earlier.edges)};
  for (KnownKeyframe& keyframe : earlier.keyframes) {
    graph.T_world_node.push_back(keyframe.T_map_camera);
    s.database.add(keyframe.bag);
    s.session = std::max(s.session, keyframe.session + 1);
    s.places.push_back({.session = keyframe.session,
                        .sequence = keyframe.sequence,
                        .submap = keyframe.submap,
                        .T_odometry_camera = keyframe.T_odometry_camera,
                        .camera = keyframe.camera,
                        .bag = std::move(keyframe.bag),
                        .stored = s.places.size()});
  }
  s.graph.resume(std::move(graph));
  s.earlier = s.asked = s.places.size();
}

KnownPlaces LoopCloser::known() const {
  const State& s = *state_;
  KnownPlaces known{.edges = s.graph.graph().edges};
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    const State::Place& place = s.places[i];
    known.keyframes.push_back({.session = place.session,
                               .sequence = place.sequence,
                               .submap = place.submap,
                               .camera = place.camera,
                               .T_odometry_camera = place.T_odometry_camera,
                               .T_map_camera = s.graph.graph().T_world_node[i],
                               .bag = place.bag});
  }
  return known;
}

Eigen::Isometry3d LoopCloser::T_map_odometry() const {
  const State& s = *state_;
  if (s.found.empty()) return Eigen::Isometry3d::Identity();
  return renormalized(s.graph.graph().T_world_node.back() *
                      s.places.back().T_odometry_camera.inverse());
}

bool LoopCloser::placed() const {
  const State& s = *state_;
  return s.places.empty() || s.graph.connected(0, s.places.size() - 1);
}

std::vector<PlacedKeyframe> LoopCloser::placed_keyframes() const {
  const State& s = *state_;
  const bool as_odometry = s.found.empty();  // to the last digit
  std::vector<PlacedKeyframe> result;
  std::map<std::size_t, bool> reached;
  for (std::size_t i = 0; i < s.places.size(); ++i) {
    const State::Place& place = s.places[i];
    const bool own = i >= s.earlier;
    const std::size_t part = s.graph.part_of(i);
    if (!own && !reached.contains(part)) reached[part] = s.reaches(part);
    if (!own && !reached[part]) continue;
    result.push_back({.sequence = place.sequence,
                      .in_earlier_map = !own,
                      .stored = place.stored,
                      .camera = place.camera,
                      .T_world_camera = own && as_odometry ? place.T_odometry_camera
                                                           : s.graph.graph().T_world_node[i]});
  }
  return result;
}

std::map<std::uint64_t, Eigen::Isometry3d> LoopCloser::poses() const {
  std::map<std::uint64_t, Eigen::Isometry3d> result;
  for (const PlacedKeyframe& keyframe : placed_keyframes()) {
    if (!keyframe.in_earlier_map) result[keyframe.sequence] = keyframe.T_world_camera;
  }
  return result;
}

std::vector<Submap> LoopCloser::submaps() const {
  const State& s = *state_;
  std::vector<Submap> result;
  for (std::size_t i = s.earlier; i < s.places.size(); ++i) {
    if (s.places[i].submap == i) result.push_back({.first_keyframe = s.places[i].sequence});
    ++result.back().keyframes;
    const std::size_t oldest = s.graph.part_of(i);
    result.back().part = s.places[s.places[oldest].submap].sequence;
    result.back().in_earlier_map = s.in_earlier_map(i);
  }
  return result;
}

std::vector<LoopClosure> LoopCloser::loops() const {
  const State& s = *state_;
  std::vector<LoopClosure> standing;
  for (const SeenAgain& loop : s.found) {
    if (!s.graph.has(loop.edge())) continue;
    standing.push_back({.candidate = s.places[loop.candidate].sequence,
                        .current = s.places[loop.current].sequence,
                        .check = loop.check,
                        .in_earlier_map = loop.candidate < s.earlier});
  }
  return standing;
}

const LoopStatistics& LoopCloser::statistics() const { return state_->statistics; }

}  // namespace sparsight
