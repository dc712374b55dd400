#include "tools/map/map_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <set>
#include <thread>

#include "tests/drivers/datasets/small_dataset.h"
#include "tests/tools/map/made_map.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

// One more session of `keyframes` keyframes, as SessionMap saves it.
Result<void> save_session(const fs::path& folder, std::uint32_t keyframes) {
  MapIndex index{.vocabulary = 1};
  auto writer = MapWriter::claim(folder, true);
  if (!writer) return tl::unexpected(writer.error());
  if (holds_map(folder)) {
    auto earlier = open_map(folder);
    if (!earlier) return tl::unexpected(earlier.error());
    index = std::move(earlier->index);
  }
  auto file = writer->new_keyframe_file();
  if (!file) return tl::unexpected(file.error());
  const auto number = static_cast<std::uint32_t>(index.files.size());
  const MapIndex made = testing::made_index();
  for (std::uint32_t i = 0; i < keyframes; ++i) {
    const auto place = file->append({.image = testing::patchwork(64, 48, 10 * number + i),
                                     .cloud_camera = testing::made_cloud(50, i)});
    index.places.push_back({.file = number, .record = place});
    KnownKeyframe keyframe = made.known.keyframes[0];
    keyframe.session = number;
    keyframe.sequence = i;
    keyframe.submap = index.known.keyframes.size();
    index.known.keyframes.push_back(keyframe);
  }
  if (auto synced = file->sync(); !synced) return synced;
  index.sessions.push_back("session");
  index.files.push_back({file->path().filename(), file->bytes()});
  return writer->commit(index);
}

// How many sessions the map holds; every one whole, or the test fails.
std::size_t sessions_in(const fs::path& folder) {
  auto map = open_map(folder);
  EXPECT_TRUE(map) << map.error().message;
  if (!map) return 0;
  for (std::size_t i = 0; i < map->index.places.size(); ++i) {
    const PagedKeyframes::Place& place = map->index.places[i];
    const auto bulk = map->files[place.file].read(*place.record);
    EXPECT_TRUE(bulk) << bulk.error().message;
    const auto sequence = static_cast<std::uint32_t>(map->index.known.keyframes[i].sequence);
    EXPECT_EQ(bulk->image.pixels, testing::patchwork(64, 48, 10 * place.file + sequence).pixels);
  }
  return map->index.sessions.size();
}

TEST(MapFolder, HoldsTheUnionOfTheSessionsThatSavedThere) {
  const TemporaryFolder folder;
  for (std::uint32_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(save_session(folder.path() / "map", 2 * i));
    EXPECT_EQ(sessions_in(folder.path() / "map"), i);
  }
  EXPECT_EQ(open_map(folder.path() / "map")->index.places.size(), 12U);
  EXPECT_EQ(names_in(folder.path() / "map"),
            (std::set<std::string>{"map.index", "keyframes-0001.bin", "keyframes-0002.bin",
                                   "keyframes-0003.bin"}));
}

TEST(MapFolder, AFolderWithoutAMapIsAnErrorThatSaysHowToMakeOne) {
  const TemporaryFolder folder;
  EXPECT_THAT(open_map(folder.path()).error().message, ::testing::HasSubstr("--save-map"));
}

TEST(MapFolder, AMapIsNotOverwrittenByASessionThatDoesNotGoOnWithIt) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_session(folder.path(), 1));
  const auto claimed = MapWriter::claim(folder.path(), false);
  ASSERT_FALSE(claimed);
  EXPECT_THAT(claimed.error().message, ::testing::HasSubstr("not overwritten"));
}

TEST(MapFolder, TwoSessionsDoNotSaveToItAtOnce) {
  const TemporaryFolder folder;
  auto first = MapWriter::claim(folder.path(), true);
  ASSERT_TRUE(first);
  EXPECT_THAT(MapWriter::claim(folder.path(), true).error().message,
              ::testing::HasSubstr("another session"));
  { const MapWriter gone = std::move(*first); }
  EXPECT_TRUE(MapWriter::claim(folder.path(), true));
}

TEST(MapFolder, AFileThatWasCutOffIsToldByName) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_session(folder.path(), 3));
  testing::truncate_file(folder.path() / "keyframes-0001.bin", 0.9);
  EXPECT_THAT(open_map(folder.path()).error().message,
              ::testing::AllOf(::testing::HasSubstr("keyframes-0001.bin"),
                               ::testing::HasSubstr("cut off")));
  fs::remove(folder.path() / "keyframes-0001.bin");
  EXPECT_THAT(open_map(folder.path()).error().message, ::testing::HasSubstr("keyframes-0001.bin"));
}

TEST(MapFolder, BringsInFilesFromElsewhere) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_session(folder.path() / "a", 2));
  auto writer = MapWriter::claim(folder.path() / "b", false);
  ASSERT_TRUE(writer);
  MapIndex index = open_map(folder.path() / "a")->index;
  index.files[0] =
      writer->adopt(folder.path() / "a" / index.files[0].name, index.files[0].bytes).value();
  ASSERT_TRUE(writer->commit(index));
  fs::remove_all(folder.path() / "a");
  EXPECT_EQ(sessions_in(folder.path() / "b"), 1U);
}

// What a power cut may leave of a session that had not come to its end: its file of keyframes and
// its index at any length. Neither is the map, and the next session clears them away.
TEST(MapFolder, WhatIsLeftOfASessionThatWasCutOffDoesNoHarm) {
  const TemporaryFolder folder;
  ASSERT_TRUE(save_session(folder.path(), 2));
  const std::string keyframes = testing::read_file(folder.path() / "keyframes-0001.bin");
  const std::string index = testing::read_file(folder.path() / "map.index");
  for (std::size_t cut = 0; cut <= 20; ++cut) {
    testing::write_file(folder.path() / "keyframes-0002.bin",
                        keyframes.substr(0, cut * keyframes.size() / 20));
    testing::write_file(folder.path() / "map.index.partial",
                        index.substr(0, cut * index.size() / 20));
    EXPECT_EQ(sessions_in(folder.path()), 1U);
  }
  ASSERT_TRUE(save_session(folder.path(), 2));
  EXPECT_EQ(sessions_in(folder.path()), 2U);
  EXPECT_EQ(names_in(folder.path()),
            (std::set<std::string>{"map.index", "keyframes-0001.bin", "keyframes-0003.bin"}));
}

// Saves sessions until it is killed.
[[noreturn]] void save_for_ever(const fs::path& folder) {
  for (;;) {
    if (!save_session(folder, 2)) ::_exit(1);
  }
}

// SIGKILL at any moment of saving: the map is what it was or one session more, and whole.
TEST(MapFolder, AProgramThatIsKilledWhileItSavesLeavesAWholeMap) {
  const TemporaryFolder folder;
  const auto begun = std::chrono::steady_clock::now();
  ASSERT_TRUE(save_session(folder.path(), 2));
  const auto once = std::chrono::steady_clock::now() - begun;
  std::size_t sessions = 1;
  std::set<std::size_t> left_overs;
  for (int part = 1; part <= 24; ++part) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) save_for_ever(folder.path());
    std::this_thread::sleep_for(part * once / 8);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "saving failed";
    const std::size_t now = sessions_in(folder.path());
    ASSERT_GE(now, sessions);
    sessions = now;
    left_overs.insert(names_in(folder.path()).size() - now);
  }
  EXPECT_GT(sessions, 2U) << "it was never fast enough to save";
  EXPECT_GT(left_overs.size(), 1U) << "it was never killed in the middle";
}

}  // namespace
}  // namespace sparsight
