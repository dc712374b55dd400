#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tools/session/simulate_session.h"
#include "tools/sparsight/fault_options.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

const std::map<std::string, SimulatedScene> kScenes{{"corridor", SimulatedScene::kCorridor},
                                                    {"hall", SimulatedScene::kHall},
                                                    {"street", SimulatedScene::kStreet}};
const std::map<std::string, ReturnMode> kReturnModeNames{{"strongest", ReturnMode::kStrongest},
                                                         {"last", ReturnMode::kLast},
                                                         {"dual", ReturnMode::kDual}};

struct SimulateArguments {
  SimulateSession session;
  double duration_s = 60.0;
  std::string size = "800x600";
  double exposure_ms = 4.0;
  bool rectified = false;
  bool no_pps = false;
  std::vector<double> clock_jump;
  std::vector<std::string> away;
  std::vector<std::string> covered;
  std::vector<std::string> carried;
  bool quiet = false;
};

bool read_size(const std::string& text, SimulationOptions& options) {
  char rest = 0;
  return std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &rest) == 2;
}

int usage(const std::string& problem) {
  std::fprintf(stderr, "sparsight simulate: %s\n", problem.c_str());
  return 2;
}

int simulate(SimulateArguments arguments) {
  SimulationOptions& options = arguments.session.options;
  options.duration = seconds_given(arguments.duration_s);
  options.exposure = std::chrono::microseconds(static_cast<long>(1000.0 * arguments.exposure_ms));
  options.lens = arguments.rectified ? SimulatedLens::kRectified : SimulatedLens::kMild;
  options.pps = !arguments.no_pps;
  if (!read_size(arguments.size, options)) return usage("--size is WIDTHxHEIGHT, as in 800x600");
  if (arguments.clock_jump.size() == 2) {
    options.faults.lidar_clock_jump = {seconds_given(arguments.clock_jump[0]),
                                       seconds_given(arguments.clock_jump[1])};
  }
  for (const std::string& away : arguments.away) {
    if (!read_away(away, options.faults)) {
      return usage(away_usage(away));
    }
  }
  for (const std::string& covered : arguments.covered) {
    if (!read_cover(covered, options.faults)) {
      return usage(cover_usage(covered));
    }
  }
  for (const std::string& carried : arguments.carried) {
    if (!read_carry(carried, options.faults)) {
      return usage(carry_usage(carried));
    }
  }
  if (arguments.session.output.empty() && arguments.session.frames.empty()) {
    return usage("nothing to write: give --output FILE.mcap, or --frames FOLDER");
  }
  if (const Result<void> checked = check(options); !checked) return usage(checked.error().message);
  const Progress::Style style = Progress::style_for(stderr, arguments.quiet);
  const Result<std::string> summary = run_simulation(arguments.session, style);
  if (!summary) {
    std::fprintf(stderr, "sparsight simulate: %s\n", summary.error().message.c_str());
    return 1;
  }
  if (!arguments.quiet) std::fputs(summary->c_str(), stdout);
  return 0;
}

void add_faults(CLI::App& command, SimulateArguments& arguments) {
  SimulatedFaults& faults = arguments.session.options.faults;
  const CLI::Range share(0.0, 1.0);
  command.add_option("--lose-frames", faults.lost_frames, "Share of frames that are lost")
      ->check(share);
  command.add_option("--lose-edges", faults.lost_edges, "Share of trigger edges that are lost")
      ->check(share);
  command.add_option("--lose-packets", faults.lost_packets, "Share of LiDAR packets that are lost")
      ->check(share);
  command
      .add_option("--lidar-clock-jump", arguments.clock_jump,
                  "AT BY: after AT seconds the LiDAR's clock is set on by BY seconds")
      ->expected(2);
  command
      .add_option("--away", arguments.away,
                  "DEVICE:FROM:SECONDS: camera, lidar or trigger is gone for a while")
      ->allow_extra_args(false);
  command
      .add_option("--cover", arguments.covered,
                  "FROM:SECONDS: the lens is covered for a while, frames are dark")
      ->allow_extra_args(false);
  command
      .add_option("--carry", arguments.carried,
                  "AT:AHEAD: after AT seconds the rig is at once where the walk would be AHEAD "
                  "seconds later (negative: was before)")
      ->allow_extra_args(false);
}

void add_look(CLI::App& command, SimulateArguments& arguments) {
  SimulationOptions& options = arguments.session.options;
  command.add_option("--size", arguments.size, "Of the frames, pixels")->capture_default_str();
  command.add_option("--rate", options.rate_hz, "Frames a second")->capture_default_str();
  command.add_option("--exposure-ms", arguments.exposure_ms, "Exposure time, milliseconds")
      ->capture_default_str();
  command
      .add_option("--exposure-drift", options.exposure_drift,
                  "Brightness wanders by this share; 0.25 is a quarter up and down")
      ->check(CLI::Range(0.0, 0.9));
  command.add_flag("--color", options.color, "A colour camera: frames with a Bayer pattern (RGGB)");
  command.add_flag("--motion-blur", options.motion_blur,
                   "Blur by motion; takes five times as long");
  command.add_flag("--rectified", arguments.rectified, "A lens without distortion");
  command.add_flag("--no-pps", arguments.no_pps, "No PPS: the LiDAR's clock runs free");
  command
      .add_option("--return-mode", options.return_mode,
                  "What the LiDAR tells: strongest, last or dual returns")
      ->transform(CLI::CheckedTransformer(kReturnModeNames, CLI::ignore_case)
                      .description("{strongest,last,dual}"))
      ->default_str("strongest");
  command.add_option("--lidar-drift-ppm", options.lidar_clock_drift_ppm, "Of the LiDAR's clock")
      ->check(CLI::Range(-200.0, 200.0))
      ->capture_default_str();
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<SimulateArguments>();
  CLI::App* command = app.add_subcommand(
      "simulate", "Make a recording of a simulated rig, with its ground truth beside it");
  command->add_option("--scene", arguments->session.options.scene, "corridor, hall or street")
      ->transform(
          CLI::CheckedTransformer(kScenes, CLI::ignore_case).description("{corridor,hall,street}"))
      ->default_str("corridor");
  command->add_option("--duration", arguments->duration_s, "Seconds; a corridor lap takes 60")
      ->check(CLI::Range(0.1, 14400.0))
      ->capture_default_str();
  command->add_option("--seed", arguments->session.options.seed, "Same seed, same bytes")
      ->capture_default_str();
  command->add_option("--output", arguments->session.output,
                      "Recording to write (.mcap); FILE.ground_truth.tum goes beside it");
  command->add_option("--frames", arguments->session.frames,
                      "Folder for the frames as PNG files and ground_truth.tum, to look at");
  add_look(*command, *arguments);
  add_faults(*command, *arguments);
  command->add_flag("--quiet", arguments->quiet, "No progress, no summary");
  command->callback([arguments, &exit_code] { exit_code = simulate(*arguments); });
}

}  // namespace sparsight
