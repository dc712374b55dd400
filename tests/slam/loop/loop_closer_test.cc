#include "slam/loop/loop_closer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "slam/loop/integrated_depth.h"
#include "slam/points/camera_returns.h"
#include "tests/build_paths.h"
#include "tests/synthetic/scene.h"

namespace sparsight {
namespace {

std::shared_ptr<const Vocabulary> shipped_vocabulary() {
  std::ifstream file(testing::source_dir() / "config/vocabulary.bin", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return std::make_shared<const Vocabulary>(
      Vocabulary::from_bytes(bytes, "config/vocabulary.bin").value());
}

// Six views of a hall a few decimetres apart, and six more of the same way, walked a little to
// the side of it.
class MadeWalk {
 public:
  static constexpr std::size_t kViews = 6;

  MadeWalk() : scene_(synthetic::make_scene("hall").value()) {
    scene_.resize(272, 204);
    std::get<synthetic::SpinningLidar>(scene_.sensor).azimuth_limit_rad =
        1.0;  // what the camera sees
    for (std::size_t i = 0; i < 2 * kViews; ++i) {
      const double seconds = 1.0 + 0.35 * static_cast<double>(i % kViews);
      Eigen::Isometry3d T_world_camera = scene_.T_world_camera(seconds);
      if (i >= kViews) T_world_camera = T_world_camera * Eigen::Translation3d(0.12, 0.04, -0.05);
      truth.push_back(T_world_camera);
      const auto there = [&](double) { return T_world_camera; };
      images.push_back(synthetic::render(scene_.world, scene_.rig.camera, there, 0.0, {}));
      const auto lidar_there = [&](double) -> Eigen::Isometry3d {
        return T_world_camera * scene_.rig.T_camera_lidar;
      };
      clouds.push_back(returns_in_image(
          synthetic::scan(scene_.world, scene_.sensor, scene_.rig, lidar_there, 0.0, 1 + i),
          camera(), scene_.rig.T_camera_lidar, constant_motion(Vector6d::Zero())));
    }
  }

  CameraModel camera() const { return CameraModel(scene_.rig.camera); }

  // As odometry would hand it over: with a drift that grows from view to view.
  RetiredKeyframe keyframe(std::size_t i) const {
    RetiredKeyframe keyframe{.sequence = 10 * i, .T_world_camera = drifted(i)};
    if (i + 1 < truth.size()) {
      Matrix6d information = Matrix6d::Zero();
      information.diagonal() << Eigen::Vector3d::Constant(1e6), Eigen::Vector3d::Constant(2.5e3);
      keyframe.successor = {.sequence = 10 * (i + 1),
                            .T_keyframe_successor = drifted(i).inverse() * drifted(i + 1),
                            .information = information};
    }
    for (const CameraReturn& r : clouds[i])
      keyframe.cloud_camera.push_back({.p_camera = r.p_camera});
    keyframe.pyramid = ImagePyramid(images[i], 4);
    return keyframe;
  }

  Eigen::Isometry3d drifted(std::size_t i) const {
    Vector6d drift = Vector6d::Zero();
    drift.tail<3>() = static_cast<double>(i) * Eigen::Vector3d(0.012, 0.002, 0.008);
    return truth[i] * exp_se3(drift);
  }

  LoopView view(std::size_t i) const {
    std::vector<Eigen::Vector3f> cloud;
    for (const CameraReturn& r : clouds[i]) cloud.push_back(r.p_camera);
    const std::vector<NearbyCloud> nearby{{.cloud = cloud}};
    return {.image = images[i],
            .returns = integrated_depth(nearby, camera()),
            .features = orb_features(images[i], {})};
  }

  std::vector<Eigen::Isometry3d> truth;
  std::vector<GreyImage> images;
  std::vector<std::vector<CameraReturn>> clouds;

 private:
  synthetic::Scene scene_;
};

const MadeWalk& made_walk() {
  static const MadeWalk kWalk;
  return kWalk;
}

OdometryConfig loop_settings() {
  OdometryConfig config;
  config.photometry.affine_brightness = true;
  config.loop.image_level = 0;
  config.loop.recent_keyframes = 4;
  config.loop.neighbours = 2;
  return config;
}

LoopVerifier verifier_of(const MadeWalk& walk) {
  const OdometryConfig config = loop_settings();
  return {walk.camera(), config.loop.verification, config.points, config.tracker,
          config.photometry};
}

TEST(LoopVerifier, FindsWhereTwoViewsOfAPlaceStand) {
  const MadeWalk& walk = made_walk();
  const LoopCheck check = verifier_of(walk).check(walk.view(8), walk.view(2));
  EXPECT_EQ(check.verdict, LoopCheck::Verdict::kAccepted) << name_of(check.verdict);
  const Eigen::Isometry3d error =
      check.T_current_candidate.inverse() * walk.truth[8].inverse() * walk.truth[2];
  EXPECT_LT(error.translation().norm(), 0.02);
  EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.2 * M_PI / 180.0);
}

TEST(LoopVerifier, RefusesViewsOfDifferentPlaces) {
  const MadeWalk& walk = made_walk();
  LoopView elsewhere = walk.view(2);
  // The same features and depths, but the image shows something else: no alignment may succeed.
  for (std::size_t i = 0; i < elsewhere.image.pixels.size(); ++i) {
    elsewhere.image.pixels[i] = walk.images[2].pixels[elsewhere.image.pixels.size() - 1 - i];
  }
  EXPECT_NE(verifier_of(walk).check(walk.view(8), elsewhere).verdict,
            LoopCheck::Verdict::kAccepted);
  elsewhere.features = orb_features(elsewhere.image, {});  // which turn with the image
  EXPECT_NE(verifier_of(walk).check(walk.view(8), elsewhere).verdict,
            LoopCheck::Verdict::kAccepted);
}

TEST(LoopVerifier, WithoutDepthThereIsNoLoop) {
  const MadeWalk& walk = made_walk();
  LoopView bare = walk.view(2);
  bare.returns.clear();
  EXPECT_EQ(verifier_of(walk).check(walk.view(8), bare).verdict, LoopCheck::Verdict::kFewMatches);
}

TEST(LoopCloser, TakesTheDriftOutOfAWalkThatComesBack) {
  const MadeWalk& walk = made_walk();
  LoopCloser closer(loop_settings(), shipped_vocabulary());
  for (std::size_t i = 0; i < walk.truth.size(); ++i) {
    closer.add(walk.keyframe(i), walk.camera().intrinsics());
  }
  closer.finish();
  ASSERT_GE(closer.loops().size(), 2) << closer.statistics().candidates;
  const std::size_t last = walk.truth.size() - 1;
  const double drift_m = (walk.drifted(last).translation() - walk.truth[last].translation()).norm();
  const Eigen::Isometry3d found = closer.poses().at(10 * last);
  EXPECT_GT(drift_m, 0.15);
  // The way out drifted too, by up to a half of that, and the loops cannot know.
  EXPECT_LT((found.translation() - walk.truth[last].translation()).norm(), 0.7 * drift_m);
  EXPECT_EQ(closer.loops()[0].current % 10, 0);
  EXPECT_LT(closer.loops()[0].candidate, closer.loops()[0].current);
}

TEST(LoopCloser, AsksLaterAboutKeyframesForWhichThereWasNoTime) {
  const MadeWalk& walk = made_walk();
  LoopCloser at_once(loop_settings(), shipped_vocabulary());
  LoopCloser later(loop_settings(), shipped_vocabulary());
  for (std::size_t i = 0; i < walk.truth.size(); ++i) {
    at_once.add(walk.keyframe(i), walk.camera().intrinsics());
    EXPECT_FALSE(later.add(walk.keyframe(i), walk.camera().intrinsics(), false));
  }
  EXPECT_TRUE(later.loops().empty());
  at_once.finish();
  later.finish();
  ASSERT_EQ(later.loops().size(), at_once.loops().size());
  for (std::size_t i = 0; i < later.loops().size(); ++i) {
    EXPECT_EQ(later.loops()[i].current, at_once.loops()[i].current);
  }
}

// The second half is metres off: tracking was lost on the way, or that is what was tracked.
class Jump : public ::testing::Test {
 protected:
  Jump() : closer_(settings(), shipped_vocabulary()) {}

  static OdometryConfig settings() {
    OdometryConfig config = loop_settings();
    config.loop.join.min_apart_m = 0.3;  // of a walk of two metres
    return config;
  }
  static Eigen::Isometry3d odometry(std::size_t i) {
    const Eigen::Isometry3d T = made_walk().drifted(i);
    return i < MadeWalk::kViews ? T : Eigen::Translation3d(90.0, 0.0, 3.0) * T;
  }
  void walk(bool lost, std::size_t views = 2 * MadeWalk::kViews) {
    add(lost, views);
    closer_.finish();
  }
  void add(bool lost, std::size_t views) {
    for (std::size_t i = 0; i < views; ++i) {
      RetiredKeyframe keyframe = made_walk().keyframe(i);
      keyframe.T_world_camera = odometry(i);
      if (lost && i + 1 == MadeWalk::kViews) keyframe.successor.reset();
      keyframe.begins_submap = lost && i == MadeWalk::kViews;
      closer_.add(keyframe, made_walk().camera().intrinsics());
    }
  }

  LoopCloser closer_;
};

TEST_F(Jump, WhereTrackingWasLostLoopsJoinWhatComesAfterToWhatWasBefore) {
  walk(true);
  EXPECT_GE(closer_.loops().size(), 2);
  EXPECT_EQ(closer_.statistics().submaps_joined, 1);
  const std::vector<Submap> submaps = closer_.submaps();
  ASSERT_EQ(submaps.size(), 2);
  EXPECT_EQ(submaps[1].first_keyframe, 10 * MadeWalk::kViews);
  EXPECT_EQ(submaps[1].keyframes, MadeWalk::kViews);
  EXPECT_EQ(submaps[1].part, submaps[0].first_keyframe);
  const auto poses = closer_.poses();
  for (std::size_t i = 0; i < made_walk().truth.size(); ++i) {
    EXPECT_LT((poses.at(10 * i).translation() - made_walk().truth[i].translation()).norm(), 0.1)
        << i;
  }
  EXPECT_TRUE(poses.at(0).isApprox(made_walk().drifted(0), 1e-9)) << "the older stays";
}

TEST_F(Jump, WhereASubmapLiesIsKnownBeforeItsKeyframesHaveTheirSuccessors) {
  add(true, MadeWalk::kViews + 3);
  EXPECT_EQ(closer_.statistics().submaps_joined, 1);
  EXPECT_TRUE(closer_.placed());
  // When they have, those that are in loops are asked about again.
  closer_.finish();
  std::set<std::pair<std::uint64_t, std::uint64_t>> pairs;
  for (const LoopClosure& loop : closer_.loops()) pairs.emplace(loop.current, loop.candidate);
  EXPECT_EQ(pairs.size(), closer_.loops().size()) << "and in no loop twice";
}

TEST_F(Jump, WhatWasTrackedIsBelievedAgainstLoops) {
  walk(false);
  EXPECT_EQ(closer_.loops().size(), 0);
  EXPECT_GE(closer_.statistics().contradicted, 2);
  EXPECT_EQ(closer_.submaps().size(), 1);
}

TEST_F(Jump, WithoutLoopsEachSubmapStandsWhereOdometryGuessed) {
  walk(true, MadeWalk::kViews + 1);  // of a single view nothing is believed
  EXPECT_TRUE(closer_.loops().empty());
  const std::vector<Submap> submaps = closer_.submaps();
  ASSERT_EQ(submaps.size(), 2);
  EXPECT_EQ(submaps[1].part, submaps[1].first_keyframe);
  EXPECT_EQ(closer_.poses().at(10 * MadeWalk::kViews).matrix(),
            odometry(MadeWalk::kViews).matrix());
}

TEST(LoopCloser, WithoutALoopThePosesAreTheOdometrys) {
  const MadeWalk& walk = made_walk();
  LoopCloser closer(loop_settings(), shipped_vocabulary());
  for (std::size_t i = 0; i < MadeWalk::kViews; ++i) {
    EXPECT_FALSE(closer.add(walk.keyframe(i), walk.camera().intrinsics()));
  }
  EXPECT_FALSE(closer.finish());
  for (std::size_t i = 0; i < MadeWalk::kViews; ++i) {
    EXPECT_EQ(closer.poses().at(10 * i).matrix(), walk.drifted(i).matrix());
  }
}

// The second half of the walk is another session's, in a world of its own.
class AnotherSession : public ::testing::Test {
 protected:
  static OdometryConfig config() {
    OdometryConfig config = loop_settings();
    config.loop.join.min_apart_m = 0.3;  // of a walk of two metres
    return config;
  }
  static void walk(LoopCloser& closer, std::size_t from, std::size_t to,
                   const Eigen::Isometry3d& T_world_hall) {
    for (std::size_t i = from; i < to; ++i) {
      RetiredKeyframe keyframe = made_walk().keyframe(i);
      keyframe.sequence -= 10 * from;  // frames count from 0 again
      if (i + 1 == to) keyframe.successor.reset();
      if (keyframe.successor) keyframe.successor->sequence -= 10 * from;
      keyframe.T_world_camera = T_world_hall * keyframe.T_world_camera;
      closer.add(keyframe, made_walk().camera().intrinsics());
    }
    closer.finish();
  }
  static KnownPlaces first_session(const std::shared_ptr<KeyframeStore>& store) {
    LoopCloser closer(config(), shipped_vocabulary(), store);
    walk(closer, 0, MadeWalk::kViews, Eigen::Isometry3d::Identity());
    return closer.known();
  }

  std::shared_ptr<KeyframeStore> store_ = std::make_shared<MemoryKeyframeStore>();
  const Eigen::Isometry3d T_world_hall_ =
      Eigen::Translation3d(40.0, -3.0, 7.0) * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY());
};

TEST_F(AnotherSession, FindsItselfInTheMapOfTheFirst) {
  LoopCloser closer(config(), shipped_vocabulary(), store_);
  closer.resume(first_session(store_));
  EXPECT_TRUE(closer.poses().empty()) << "none of this session yet";
  walk(closer, MadeWalk::kViews, 2 * MadeWalk::kViews, T_world_hall_);
  ASSERT_FALSE(closer.loops().empty());
  EXPECT_TRUE(closer.loops()[0].in_earlier_map);
  const auto poses = closer.poses();
  ASSERT_EQ(poses.size(), MadeWalk::kViews);
  for (const auto& [sequence, T_map_camera] : poses) {
    const Eigen::Isometry3d& truth = made_walk().truth[MadeWalk::kViews + sequence / 10];
    EXPECT_LT((T_map_camera.translation() - truth.translation()).norm(), 0.1) << sequence;
  }
  ASSERT_EQ(closer.submaps().size(), 1);
  EXPECT_TRUE(closer.submaps()[0].in_earlier_map);
  // The map is that of both.
  const auto placed = closer.placed_keyframes();
  ASSERT_EQ(placed.size(), 2 * MadeWalk::kViews);
  EXPECT_TRUE(placed[MadeWalk::kViews - 1].in_earlier_map);
  EXPECT_FALSE(placed[MadeWalk::kViews].in_earlier_map);
  for (std::size_t i = 0; i < placed.size(); ++i) EXPECT_EQ(placed[i].stored, i);
  // What it leaves to a third session is both, too.
  const KnownPlaces known = closer.known();
  ASSERT_EQ(known.keyframes.size(), 2 * MadeWalk::kViews);
  EXPECT_EQ(known.keyframes[MadeWalk::kViews - 1].session, 0);
  EXPECT_EQ(known.keyframes[MadeWalk::kViews].session, 1);
  EXPECT_EQ(known.keyframes[MadeWalk::kViews].submap, MadeWalk::kViews);
  EXPECT_EQ(known.edges.size(), 2 * (MadeWalk::kViews - 1) + closer.loops().size());
}

TEST_F(AnotherSession, WhereNothingIsRecognisedStaysInItsOwnFrame) {
  LoopCloser closer(config(), shipped_vocabulary(), store_);
  closer.resume(first_session(store_));
  walk(closer, MadeWalk::kViews, MadeWalk::kViews + 1, T_world_hall_);
  EXPECT_TRUE(closer.loops().empty());
  EXPECT_FALSE(closer.submaps()[0].in_earlier_map);
  EXPECT_TRUE(closer.poses().at(0).isApprox(
      T_world_hall_ * made_walk().keyframe(MadeWalk::kViews).T_world_camera, 1e-12));
  EXPECT_EQ(closer.placed_keyframes().size(), 1) << "two frames do not make one map";
  EXPECT_EQ(closer.known().keyframes.size(), MadeWalk::kViews + 1) << "but nothing is lost";
}

TEST_F(AnotherSession, AThirdGoesOnWithBoth) {
  LoopCloser second(config(), shipped_vocabulary(), store_);
  second.resume(first_session(store_));
  walk(second, MadeWalk::kViews, 2 * MadeWalk::kViews, T_world_hall_);
  LoopCloser third(config(), shipped_vocabulary(), store_);
  third.resume(second.known());
  walk(third, 0, MadeWalk::kViews, T_world_hall_.inverse());
  ASSERT_FALSE(third.loops().empty());
  EXPECT_EQ(third.known().keyframes.back().session, 2);
  for (const auto& [sequence, T_map_camera] : third.poses()) {
    const Eigen::Isometry3d& truth = made_walk().truth[sequence / 10];
    EXPECT_LT((T_map_camera.translation() - truth.translation()).norm(), 0.1) << sequence;
  }
}

TEST(IntegratedDepth, NeighboursFillWhatOneScanLeavesOpen) {
  const MadeWalk& walk = made_walk();
  std::vector<std::vector<Eigen::Vector3f>> clouds(3);
  std::vector<NearbyCloud> nearby;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    for (const CameraReturn& r : walk.clouds[2 + i]) clouds[i].push_back(r.p_camera);
    nearby.push_back({walk.truth[3].inverse() * walk.truth[2 + i], clouds[i]});
  }
  const auto alone = integrated_depth(std::span(nearby).subspan(1, 1), walk.camera());
  const auto together = integrated_depth(nearby, walk.camera());
  EXPECT_GT(together.size(), 3 * alone.size() / 2);
  // And what they say of a pixel agrees with what is there.
  const DepthLookup lookup(together, walk.camera());
  std::size_t known = 0;
  for (const CameraReturn& r : alone) {
    const auto p = lookup.at(r.pixel);
    if (!p) continue;
    ++known;
    EXPECT_NEAR(p->z(), r.p_camera.z(), 0.06 * r.p_camera.z() + 0.05);
  }
  EXPECT_GT(known, alone.size() / 5);
}

TEST(IntegratedDepth, OfNothingNothing) {
  EXPECT_TRUE(integrated_depth({}, made_walk().camera()).empty());
  const std::vector<CameraReturn> none;
  EXPECT_FALSE(DepthLookup(none, made_walk().camera()).at({10.0F, 10.0F}));
}

}  // namespace
}  // namespace sparsight
