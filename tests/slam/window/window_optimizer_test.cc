#include "slam/window/window_optimizer.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "slam/tracking/photometric_reference.h"
#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

// Steps of 15 to 20 cm with small turns, as between the keyframes of a walk.
Eigen::Isometry3d true_pose(int i) {
  return pose(0.012 * std::sin(i), 0.025 * i, 0.01 * std::cos(i) - 0.01, 0.06 * i, 0.02 * i,
              0.17 * i);
}

// A window whose keyframes stay within the test's reach: their poses are its to move.
struct Window {
  Window(const SineRoom& room, int count, double noise_grey = 0.0, const WindowConfig& config = {},
         const PhotometryConfig& photometry = {})
      : optimizer(room.camera(), config, photometry) {
    for (int i = 0; i < count; ++i) add(room, i, noise_grey);
  }
  void add(const SineRoom& room, int i, double noise_grey = 0.0,
           const Brightness& brightness = {}) {
    const auto seed = static_cast<std::uint32_t>(i) + 1U;
    add(room.keyframe(static_cast<std::uint64_t>(i), true_pose(i),
                      room.image(true_pose(i), brightness, noise_grey, seed)));
  }
  void add(Keyframe&& made) {
    auto keyframe = std::make_unique<Keyframe>(std::move(made));
    keyframes.push_back(keyframe.get());
    optimizer.add(std::move(keyframe));
  }
  MarginalizedKeyframe marginalize() {
    keyframes.erase(keyframes.begin());
    return optimizer.marginalize_oldest();
  }
  Eigen::Isometry3d relative(int from, int to) const {
    return keyframes[static_cast<std::size_t>(from)]->T_world_camera.inverse() *
           keyframes[static_cast<std::size_t>(to)]->T_world_camera;
  }

  WindowOptimizer optimizer;
  std::vector<Keyframe*> keyframes;
};

Vector6d disturbance(int i) {
  Vector6d xi;
  xi << 0.006, -0.005, 0.004, -0.03, 0.02, 0.04;
  return (i % 2 == 0 ? 1.0 : -1.0) * xi;
}

// The energy as it stands: no step is taken.
constexpr WindowConfig kOnlyLook{.size = 10, .max_iterations = 0};

CameraModel with_k1(const SineRoom& room, double k1) {
  CameraIntrinsics c = room.intrinsics;
  c.k1 += k1;
  return CameraModel(c);
}

// The newest was made through the camera already; tracking holds its patches.
TEST(WindowOptimizer, SeesEarlierKeyframesThroughAnotherCamera) {
  const SineRoom room;
  const CameraModel other = with_k1(room, 0.02);
  Window window(room, 3);
  const PatchSet newest = window.keyframes[2]->patches.front();
  window.optimizer.set_camera(other);
  for (const std::size_t earlier : {0U, 1U}) {
    const Keyframe& keyframe = *window.keyframes[earlier];
    const PatchSet expected = make_patches(keyframe.pyramid, 0, other, keyframe.points, 0.0);
    EXPECT_EQ(keyframe.patches.front().x, expected.x);
    EXPECT_EQ(keyframe.patches.front().intensity, expected.intensity);
  }
  EXPECT_EQ(window.keyframes[2]->patches.front().x, newest.x);
}

TEST(WindowOptimizer, ComparesPairsAnewWhereTheCameraHasChangedByMuchOrOften) {
  const SineRoom room;
  Window window(room, 3);
  const double energy = window.optimizer.optimize().final_energy;
  const auto energy_with = [&](double k1) {
    window.optimizer.set_camera(with_k1(room, k1));
    return window.optimizer.optimize(0).initial_energy;
  };
  EXPECT_EQ(energy_with(1e-4), energy);
  EXPECT_GT(energy_with(0.2), 1.05 * energy);
  double last = energy_with(0.2);
  int looks = 0;
  for (double k1 = 0.2; k1 > 0.0; k1 -= 0.005) {
    const double now = energy_with(k1);
    looks += now != last;
    last = now;
  }
  EXPECT_GT(looks, 3) << "small changes add up";
  EXPECT_NEAR(last, energy, 0.02 * energy);
}

TEST(WindowOptimizer, BringsDisturbedKeyframesBack) {
  const SineRoom room;
  Window window(room, 4);
  for (std::size_t i = 1; i < 4; ++i) {
    Eigen::Isometry3d& T = window.keyframes[i]->T_world_camera;
    T = T * exp_se3(disturbance(static_cast<int>(i)));
  }
  const WindowSummary summary = window.optimizer.optimize();
  EXPECT_TRUE(summary.converged);
  EXPECT_EQ(summary.pairs, 12);
  EXPECT_LT(summary.iterations, 15);
  EXPECT_EQ(window.optimizer.oldest().T_world_camera.matrix(), true_pose(0).matrix()) << "held";
  for (int i = 1; i < 4; ++i) {
    const Eigen::Isometry3d& T = window.optimizer.keyframe(i).T_world_camera;
    EXPECT_LT(turn_between(T, true_pose(i)), 2e-4) << i;
    EXPECT_LT(shift_between(T, true_pose(i)), 1e-3) << i;
  }
}

TEST(WindowOptimizer, LeavesOneKeyframeOrNoneAlone) {
  const SineRoom room;
  Window window(room, 0);
  EXPECT_EQ(window.optimizer.optimize().iterations, 0);
  window.add(room, 0);
  EXPECT_EQ(window.optimizer.optimize().iterations, 0);
  EXPECT_EQ(window.optimizer.oldest().T_world_camera.matrix(), true_pose(0).matrix());
}

TEST(WindowOptimizer, LeavesOutWhatIsNotCovisible) {
  const SineRoom room;
  Window window(room, 3);
  SineRoom elsewhere = room;
  elsewhere.pattern = 5;
  window.add(elsewhere.keyframe(3, true_pose(3)));  // claims to be here, and is not
  const Eigen::Isometry3d T_behind = true_pose(0) * pose(0.0, 3.0, 0.0, 0.0, 0.0, 0.0);
  window.add(room.keyframe(4, T_behind));
  window.keyframes[2]->T_world_camera = true_pose(2) * exp_se3(disturbance(0));
  const WindowSummary summary = window.optimizer.optimize();
  EXPECT_EQ(summary.pairs, 6);
  EXPECT_LT(shift_between(window.keyframes[2]->T_world_camera, true_pose(2)), 1e-3);
  EXPECT_LT(shift_between(window.keyframes[3]->T_world_camera, true_pose(3)), 1e-9);
  EXPECT_LT(shift_between(window.keyframes[4]->T_world_camera, T_behind), 1e-9);
}

TEST(WindowOptimizer, LearnsTheBrightnessOfEveryPairIfTold) {
  const SineRoom room;
  Window window(room, 0, 0.0, {}, {.affine_brightness = true});
  window.add(room, 0);
  window.add(room, 1, 0.0, {0.8, 15.0});
  window.add(room, 2, 0.0, {1.15, -12.0});
  for (std::size_t i = 1; i < 3; ++i) {
    Eigen::Isometry3d& T = window.keyframes[i]->T_world_camera;
    T = T * exp_se3(0.5 * disturbance(static_cast<int>(i)));
  }
  EXPECT_EQ(window.optimizer.optimize().pairs, 6);
  for (int i = 1; i < 3; ++i) {
    const Eigen::Isometry3d& T = window.optimizer.keyframe(i).T_world_camera;
    EXPECT_LT(turn_between(T, true_pose(i)), 3e-4) << i;
    EXPECT_LT(shift_between(T, true_pose(i)), 2e-3) << i;
  }
}

// The same energy, written down again: Gauss-Newton over left increments in the world, with the
// scalar kernel and no damping.
std::vector<Eigen::Isometry3d> plain_gauss_newton(const SineRoom& room,
                                                  const std::vector<Keyframe*>& keyframes) {
  const auto n = static_cast<int>(keyframes.size());
  std::vector<Eigen::Isometry3d> T;
  for (const Keyframe* keyframe : keyframes) T.push_back(keyframe->T_world_camera);
  for (int iteration = 0; iteration < 25; ++iteration) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(6 * n);
    for (std::size_t host = 0; host < T.size(); ++host) {
      for (std::size_t target = 0; target < T.size(); ++target) {
        if (host == target) continue;
        const PatchSet& patches = keyframes[host]->patches[0];
        Linearization l;
        reference::linearize(patches, keyframes[target]->pyramid.level(0), room.camera(),
                             T[target].inverse() * T[host], {}, l);
        const double sigma = reference::estimate_sigma(l, 5.0, 5.0);
        const NormalEquations pair = reference::accumulate(patches, l, 5.0, sigma);
        // T_t^-1 exp(-d_t) exp(d_h) T_h = exp(Ad(T_t^-1) (d_h - d_t)) T_t^-1 T_h
        Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, 6 * n);
        J.middleCols<6>(6 * static_cast<Eigen::Index>(host)) = adjoint(T[target].inverse());
        J.middleCols<6>(6 * static_cast<Eigen::Index>(target)) = -adjoint(T[target].inverse());
        H += J.transpose() * pair.H.topLeftCorner<6, 6>() * J / (sigma * sigma);
        b += J.transpose() * pair.b.head<6>() / (sigma * sigma);
      }
    }
    const Eigen::Index free = 6 * n - 6;
    const Eigen::VectorXd step = H.bottomRightCorner(free, free).ldlt().solve(-b.tail(free));
    for (std::size_t i = 1; i < T.size(); ++i) {
      T[i] = exp_se3(Vector6d(step.segment<6>(6 * static_cast<Eigen::Index>(i) - 6))) * T[i];
    }
  }
  return T;
}

TEST(WindowOptimizer, FindsWhatAnotherSolverFinds) {
  const SineRoom room;
  WindowConfig patient;
  patient.convergence_px = 1e-4;
  patient.relinearization_px = 1e-4;
  patient.max_iterations = 50;
  Window window(room, 3, 3.0, patient);
  for (std::size_t i = 1; i < 3; ++i) {
    Eigen::Isometry3d& T = window.keyframes[i]->T_world_camera;
    T = T * exp_se3(0.5 * disturbance(static_cast<int>(i)));
  }
  const std::vector<Eigen::Isometry3d> expected = plain_gauss_newton(room, window.keyframes);
  window.optimizer.optimize();
  for (int i = 1; i < 3; ++i) {
    const Eigen::Isometry3d& T = window.optimizer.keyframe(i).T_world_camera;
    const auto index = static_cast<std::size_t>(i);
    const double error = shift_between(expected[index], true_pose(i));
    EXPECT_GT(error, 2e-3) << "noise moves the minimum; else this test could not fail";
    EXPECT_LT(shift_between(T, expected[index]), 5e-4) << i;
    EXPECT_LT(turn_between(T, expected[index]), 1e-4) << i;
  }
}

// What has not moved far keeps its linearisation, and that changes next to nothing.
TEST(WindowOptimizer, FindsTheSameWithoutLookingAgainAtWhatHardlyMoves) {
  const SineRoom room;
  WindowConfig thorough;
  thorough.relinearization_px = 0.0;
  Window lazy(room, 4, 3.0);
  Window always(room, 4, 3.0, thorough);
  for (Window* window : {&lazy, &always}) {
    window->optimizer.optimize();
    window->add(room, 4, 3.0);
    Eigen::Isometry3d& T = window->keyframes.back()->T_world_camera;
    T = T * exp_se3(0.5 * disturbance(0));
    window->optimizer.optimize();
  }
  for (std::size_t i = 1; i < 5; ++i) {
    const Eigen::Isometry3d& T = lazy.keyframes[i]->T_world_camera;
    EXPECT_LT(shift_between(T, always.keyframes[i]->T_world_camera), 1e-3)
        << i << ": noise moves it by more than 2e-3";
    EXPECT_LT(turn_between(T, always.keyframes[i]->T_world_camera), 1e-4) << i;
  }
}

TEST(WindowOptimizer, EnergyDoesNotDependOnWhereTheWorldBegins) {
  const SineRoom room;
  Window window(room, 3, 0.0, kOnlyLook);
  window.keyframes[1]->T_world_camera = true_pose(1) * exp_se3(disturbance(1));
  const double energy = window.optimizer.optimize().initial_energy;
  const Eigen::Isometry3d T_new_old = pose(0.5, -1.0, 2.0, 300.0, -20.0, 100.0);
  for (Keyframe* keyframe : window.keyframes) {
    keyframe->T_world_camera = T_new_old * keyframe->T_world_camera;
  }
  EXPECT_NEAR(window.optimizer.optimize().initial_energy, energy, 1e-5 * energy);
  window.keyframes[1]->T_world_camera =
      window.keyframes[1]->T_world_camera * exp_se3(disturbance(0));
  EXPECT_GT(std::abs(window.optimizer.optimize().initial_energy - energy), 1e-3 * energy);
}

// The prior holds no opinion about the pose of the whole window, also after its keyframes have
// moved between two marginalisations: the first-estimate Jacobians' purpose.
TEST(WindowOptimizer, PriorDoesNotHoldTheWholeWindow) {
  const SineRoom room;
  Window window(room, 5, 0.0, kOnlyLook);
  for (std::size_t i = 1; i < 5; ++i) {
    window.keyframes[i]->T_world_camera =
        true_pose(static_cast<int>(i)) * exp_se3(0.3 * disturbance(static_cast<int>(i)));
  }
  window.marginalize();
  for (Keyframe* keyframe : window.keyframes) {
    ASSERT_TRUE(keyframe->T_world_camera_first.has_value());
    keyframe->T_world_camera = keyframe->T_world_camera * exp_se3(Vector6d::Constant(0.003));
  }
  window.optimizer.optimize();  // looks at them anew
  window.marginalize();

  const auto energy_after = [&](const Eigen::Isometry3d& T_new_old) {
    for (Keyframe* keyframe : window.keyframes) {
      keyframe->T_world_camera = T_new_old * *keyframe->T_world_camera_first;
    }
    return window.optimizer.optimize().initial_energy;
  };
  const double energy = energy_after(Eigen::Isometry3d::Identity());
  const double shifted = energy_after(pose(0.3, -0.4, 0.2, 3.0, -2.0, 1.0));
  EXPECT_NEAR(shifted, energy, 1e-5 * energy);
}

// Four keyframes with a prior against the five they came from, both with a new one.
TEST(WindowOptimizer, PriorSaysWhatTheLeaverKnew) {
  const SineRoom room;
  constexpr double kNoise = 4.0;
  WindowConfig precise{.size = 10, .max_iterations = 40, .convergence_px = 1e-3};
  Window full(room, 4, kNoise, precise);
  Window reduced(room, 4, kNoise, precise);
  full.optimizer.optimize();
  reduced.optimizer.optimize();
  reduced.marginalize();
  Window forgetful(room, 0, 0.0, precise);
  for (int i = 1; i < 5; ++i) forgetful.add(room, i, kNoise);
  full.add(room, 4, kNoise);
  reduced.add(room, 4, kNoise);
  full.optimizer.optimize();
  reduced.optimizer.optimize();
  forgetful.optimizer.optimize();

  const Eigen::Isometry3d expected = full.relative(1, 3);
  const double lost = shift_between(forgetful.relative(0, 2), expected);
  EXPECT_GT(lost, 3e-4) << "the leaver must matter for this test to";
  EXPECT_LT(shift_between(reduced.relative(0, 2), expected), 0.2 * lost);
}

TEST(WindowOptimizer, LeaverTellsWhatItKnewOfItsSuccessor) {
  const SineRoom room;
  Window window(room, 2, 0.0, kOnlyLook);
  AlignmentWorkspace workspace;
  const Keyframe& first = *window.keyframes[0];
  const Keyframe& second = *window.keyframes[1];
  const Eigen::Isometry3d T_first_second = window.relative(0, 1);
  const auto information = [&](const Keyframe& host, const Keyframe& target,
                               const Eigen::Isometry3d& T_target_host) {
    Alignment at;
    at.T_camera_keyframe = T_target_host;
    return pair_term(host, target, room.camera(), at, {}, workspace).H;
  };
  // A left increment of T_first_second is -Ad(T_second_first) that of its inverse.
  const Matrix6d A = adjoint(T_first_second.inverse());
  const Matrix6d expected =
      information(second, first, T_first_second) +
      A.transpose() * information(first, second, T_first_second.inverse()) * A;
  const MarginalizedKeyframe leaver = window.marginalize();
  EXPECT_LT((leaver.successor_information - expected).norm(), 1e-6 * expected.norm());
  EXPECT_EQ(leaver.keyframe->sequence, 0U);
}

TEST(WindowOptimizer, LeaversInformationIsPositiveAndGrowsWithMoreKeyframes) {
  const SineRoom room;
  const auto information = [&](int keyframes) {
    Window window(room, keyframes, 5.0, {.size = 10});
    window.optimizer.optimize();
    return window.marginalize().successor_information;
  };
  const Matrix6d two = information(2);
  const Matrix6d four = information(4);
  EXPECT_EQ(two.llt().info(), Eigen::Success);
  EXPECT_EQ(four.llt().info(), Eigen::Success);
  EXPECT_LT((two - two.transpose()).norm(), 1e-9 * two.norm());
  EXPECT_GT(four.determinant(), two.determinant());
}

TEST(WindowOptimizer, EmptiesFromTheOldestOn) {
  const SineRoom room;
  Window window(room, 3, 0.0, {.size = 2});
  EXPECT_TRUE(window.optimizer.full());
  for (std::uint64_t sequence = 0; sequence < 3; ++sequence) {
    const MarginalizedKeyframe leaver = window.marginalize();
    EXPECT_EQ(leaver.keyframe->sequence, sequence);
    EXPECT_TRUE(leaver.successor_information.allFinite());
    if (sequence == 2) {
      EXPECT_EQ(leaver.successor_information, Matrix6d::Zero());
    }
  }
  EXPECT_EQ(window.optimizer.size(), 0);
  window.add(room, 0);
  window.add(room, 1);
  EXPECT_EQ(window.optimizer.optimize().pairs, 2) << "and can be filled again";
}

}  // namespace
}  // namespace sparsight
