#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/configuration/profile.h"
#include "tools/session/replay_session.h"
#include "tools/session/session_text.h"
#include "tools/sparsight/map_options.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kUsage = 2;

int replay(ReplayOptions options) {
  const auto config = load_profile(options.profile_name);
  if (!config) {
    fmt::print(stderr, "{}\n", config.error().message);
    return kUsage;
  }
  options.config = *config;
  if (options.no_loops) options.config.loop.enabled = false;
  const auto result = replay_session(options);
  if (!result) {
    fmt::print(stderr, "{}\n", result.error().message);
    return kFailed;
  }
  if (!options.quiet) fmt::print("{}", session_text(result->session, result->folder));
  if (!result->failure) return kDone;
  fmt::print(stderr, "{}\n", result->failure->message);
  return kFailed;
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay", "Replay a recording through the odometry; write trajectory, map and report");
  command
      ->add_option(
          "SOURCE", options->source,
          "recording (.mcap), KITTI odometry sequence, KITTI raw drive, or a folder with a "
          "capture (lidar.pcap, images/, times.txt, rig.toml)")
      ->required();
  command->add_option("--rays", options->rays, "keep N of the scan's rings, evenly")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_option("--camera", options->camera, "camera to track (default: the lowest)")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--profile", options->profile_name, "paper, default, or a TOML file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command->add_option("--max-frames", options->max_frames, "stop after N frames")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--output", options->output,
                   "session folder (default: a new ./session-NAME); an earlier session is replaced")
      ->type_name("DIR");
  command
      ->add_option("--ground-truth", options->ground_truth,
                   "true path, KITTI or TUM format (default: the data set's own, if it is there)")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->add_flag("--quiet", options->quiet, "no progress and no summary");
  command->add_flag("--no-loops", options->no_loops, "odometry alone, whatever the profile says");
  add_map_options(*command, options->map, options->maps);
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace sparsight
