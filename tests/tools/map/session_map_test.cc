#include "tools/map/session_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/datasets/small_dataset.h"
#include "tests/tools/map/made_keyframe.h"
#include "tools/loop/vocabulary_file.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

const CameraIntrinsics kCamera{400, 300, 200, 200, 199.5, 149.5};

class SessionWithMap : public ::testing::Test {
 protected:
  Result<SessionMap> open(const SessionMapOptions& options,
                          const CameraIntrinsics& camera = kCamera, const LoopConfig& config = {}) {
    keyframes_ = std::make_shared<PagedKeyframes>();
    return SessionMap::open(options, config, camera, *vocabulary_, *keyframes_);
  }

  // A session of three keyframes.
  void walk(SessionMap& map, const std::string& source) {
    LoopCloser loops(OdometryConfig{}, vocabulary_, keyframes_);
    map.resume(loops);
    for (std::uint64_t i = 0; i < 3; ++i)
      loops.add(testing::made_keyframe(i, 400, 300, 60), kCamera);
    const auto saved = map.save(loops, *vocabulary_, source, *keyframes_);
    ASSERT_TRUE(saved) << saved.error().message;
  }
  void save_first(const std::filesystem::path& folder) {
    auto map = open({.save_to = folder});
    ASSERT_TRUE(map) << map.error().message;
    walk(*map, "first");
  }

  testing::TemporaryFolder folder_;
  const std::filesystem::path a_ = folder_.path() / "a";
  const std::filesystem::path b_ = folder_.path() / "b";
  std::shared_ptr<const Vocabulary> vocabulary_ = built_in_vocabulary();
  std::shared_ptr<PagedKeyframes> keyframes_;
};

TEST_F(SessionWithMap, LeavesTheUnionWhereItCameFromOrElsewhere) {
  save_first(a_);
  for (const auto& to : {b_, a_}) {
    auto map = open({.earlier = a_, .save_to = to});
    ASSERT_TRUE(map) << map.error().message;
    walk(*map, "second");
    const auto opened = open_map(to);
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(opened->index.sessions, (std::vector<std::string>{"first", "second"}));
    EXPECT_EQ(opened->index.places.size(), 6U);
    EXPECT_EQ(opened->index.known.keyframes[3].session, 1U);
    EXPECT_EQ(opened->index.known.keyframes[3].submap, 3U);
  }
}

TEST_F(SessionWithMap, OnlyToFindItsPlaceChangesNothing) {
  save_first(a_);
  const std::string before = testing::read_file(a_ / "map.index");
  auto map = open({.earlier = a_});
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_FALSE(keyframes_->writes()) << "the session's own folder is for that";
  walk(*map, "second");
  EXPECT_EQ(testing::read_file(a_ / "map.index"), before);
}

TEST_F(SessionWithMap, AMapOfAnotherCameraIsRefused) {
  save_first(a_);
  CameraIntrinsics other = kCamera;
  other.fx = other.fy = 230;
  EXPECT_THAT(open({.earlier = a_}, other).error().message, HasSubstr("another camera"));
  other = kCamera;
  other.width = 640;
  EXPECT_THAT(open({.earlier = a_}, other).error().message, HasSubstr("another camera"));
  other = kCamera;
  other.fx *= 1.004;  // as self-calibration may find it
  EXPECT_TRUE(open({.earlier = a_}, other));
}

TEST_F(SessionWithMap, WithoutLoopsThereIsNone) {
  EXPECT_THAT(open({.save_to = a_}, kCamera, {.enabled = false}).error().message,
              HasSubstr("need loops"));
  EXPECT_TRUE(open({}, kCamera, {.enabled = false}));
}

TEST_F(SessionWithMap, WordsOfAnotherVocabularyAreFoundAgain) {
  save_first(a_);
  MapIndex index = open_map(a_)->index;
  const BagOfWords bag = index.known.keyframes[1].bag;
  ASSERT_GT(bag.size(), 50U);
  index.vocabulary += 1;
  for (KnownKeyframe& keyframe : index.known.keyframes) keyframe.bag = {{4'000'000'000, 1.0F}};
  {
    auto writer = MapWriter::claim(a_, true);
    ASSERT_TRUE(writer->commit(index));
  }
  auto map = open({.earlier = a_});
  ASSERT_TRUE(map) << map.error().message;
  LoopCloser loops(OdometryConfig{}, vocabulary_, keyframes_);
  map->resume(loops);
  EXPECT_GT(similarity(loops.known().keyframes[1].bag, bag), 0.999);
}

}  // namespace
}  // namespace sparsight
