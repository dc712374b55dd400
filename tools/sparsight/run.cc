#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <map>
#include <memory>
#include <string>

#include "tools/configuration/profile.h"
#include "tools/session/live_session.h"
#include "tools/session/progress.h"
#include "tools/session/session_folder.h"
#include "tools/session/session_text.h"
#include "tools/session/simulate_session.h"
#include "tools/sparsight/map_options.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

constexpr int kRunDone = 0;
constexpr int kRunFailed = 1;
constexpr int kRunUsage = 2;

const std::map<std::string, SimulatedScene> kPlayedScenes{{"corridor", SimulatedScene::kCorridor},
                                                          {"hall", SimulatedScene::kHall},
                                                          {"street", SimulatedScene::kStreet}};

struct LiveArguments {
  std::string rig;
  std::string play;
  int repeat = 1;
  std::string simulated;
  std::optional<std::filesystem::path> output;
  double seconds = 0.0;
  bool no_recording = false;
  bool no_realtime = false;
  LiveOptions options;
};

int fail_run(const Error& error, int code) {
  fmt::print(stderr, "sparsight: {}\n", error.message);
  return code;
}

// What was recorded is never written over.
Result<std::filesystem::path> new_folder(const LiveArguments& arguments,
                                         const std::filesystem::path& source) {
  std::error_code error;
  if (arguments.output && std::filesystem::exists(*arguments.output / "recording.mcap", error)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: holds a recording; give --output another folder",
                            arguments.output->string()));
  }
  return claim_session_folder(arguments.output, source, std::nullopt);
}

// Two cores do not render as fast as time goes: the scene is made first, then played.
Result<std::filesystem::path> simulate_into(const std::filesystem::path& folder,
                                            const LiveArguments& arguments) {
  SimulateSession simulation;
  simulation.options.scene = kPlayedScenes.at(arguments.simulated);
  const double seconds = arguments.seconds > 0.0 ? arguments.seconds : 20.0;
  simulation.options.duration = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * seconds));
  simulation.output = (folder / "simulated.mcap").string();
  const auto style = Progress::style_for(stderr, arguments.options.quiet);
  return run_simulation(simulation, style).map([&](const std::string&) {
    return std::filesystem::path(simulation.output);
  });
}

// A scene is made into the folder; anything else must be there before a folder is made for it.
Result<LiveRig> open_into_folder(LiveArguments& arguments) {
  LiveOptions& options = arguments.options;
  const auto claim = [&](const std::string& source) {
    return new_folder(arguments, source).map([&](const std::filesystem::path& folder) {
      options.folder = folder;
    });
  };
  if (!arguments.simulated.empty()) {
    return claim(arguments.simulated)
        .and_then([&] { return simulate_into(options.folder, arguments); })
        .and_then([](const std::filesystem::path& made) { return play_recording(made, ""); });
  }
  const bool played = !arguments.play.empty();
  auto rig = played ? play_recording(arguments.play, arguments.rig, arguments.repeat)
                    : open_rig(arguments.rig);
  if (!rig) return rig;
  if (auto claimed = claim(played ? arguments.play : arguments.rig); !claimed) {
    return tl::unexpected(claimed.error());
  }
  return rig;
}

Result<void> settle(LiveArguments& arguments) {
  LiveOptions& options = arguments.options;
  const int sources = !arguments.play.empty() + !arguments.simulated.empty();
  if (sources > 1 || (sources == 0 && arguments.rig.empty())) {
    return fail(ErrorCode::kMissingField,
                "give --rig FILE, or --play RECORDING, or --simulated SCENE");
  }
  auto config = load_profile(options.profile_name);
  if (!config) return tl::unexpected(config.error());
  options.config = *config;
  options.recording = !arguments.no_recording;
  options.realtime = !arguments.no_realtime;
  if (arguments.seconds > 0.0 && arguments.simulated.empty()) {  // a scene ends by itself
    options.duration = std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * arguments.seconds));
  }
  return {};
}

int run_rig(LiveArguments arguments) {
  const LiveOptions& options = arguments.options;
  if (const auto settled = settle(arguments); !settled) {
    return fail_run(settled.error(), kRunUsage);
  }
  auto rig = open_into_folder(arguments);
  if (!rig) return fail_run(rig.error(), kRunFailed);
  const auto result = run_live(std::move(*rig), options);
  if (!result) return fail_run(result.error(), kRunFailed);
  if (!options.quiet && !options.json) {
    fmt::print("{}", session_text(result->session, options.folder));
  }
  return result->failure ? fail_run(*result->failure, kRunFailed) : kRunDone;
}

void add_common(CLI::App& command, LiveArguments& arguments) {
  LiveOptions& options = arguments.options;
  command.add_option("--rig", arguments.rig, "rig file, such as config/rig/handheld.toml")
      ->type_name("FILE");
  command
      .add_option("--play", arguments.play,
                  "instead of devices: a recording as if it happened now, with its own timing")
      ->type_name("RECORDING");
  command.add_option("--repeat", arguments.repeat, "play it N times, one after the other")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command
      .add_option("--output", arguments.output,
                  "session folder (default: a new ./session-NAME); the recording goes there too")
      ->type_name("DIR");
  command.add_option("--seconds", arguments.seconds, "end after so long (default: when asked to)")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  command.add_flag("--no-realtime", arguments.no_realtime,
                   "do not ask for real-time scheduling and locked memory");
  command.add_flag("--json", options.json, "a line of JSON every second, for machines");
  command.add_flag("--quiet", options.quiet, "no state every second, no summary");
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<LiveArguments>();
  CLI::App* command = app.add_subcommand(
      "run", "Run on the rig: track, map and record, until asked to end (Ctrl-C, SIGTERM)");
  add_common(*command, *arguments);
  command
      ->add_option("--simulated", arguments->simulated,
                   "instead of devices: make a scene (corridor, hall or street) and play it")
      ->type_name("SCENE")
      ->check(CLI::IsMember({"corridor", "hall", "street"}));
  command
      ->add_option("--profile", arguments->options.profile_name, "paper, default, or a TOML file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command->add_flag("--no-recording", arguments->no_recording,
                    "do not record what the rig delivers");
  add_map_options(*command, arguments->options.map, arguments->options.maps);
  command->callback([arguments, &exit_code] { exit_code = run_rig(*arguments); });
}

void add_record(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<LiveArguments>();
  arguments->options.odometry = false;
  CLI::App* command =
      app.add_subcommand("record", "Record what the rig delivers, without tracking it");
  add_common(*command, *arguments);
  command->callback([arguments, &exit_code] { exit_code = run_rig(*arguments); });
}

}  // namespace sparsight
