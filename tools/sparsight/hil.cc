#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "tools/playback/playback_session.h"
#include "tools/sparsight/fault_options.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

struct HilArguments {
  PlaybackOptions options;
  double lead_s = 3.0;
  std::vector<std::string> away;
  bool json = false;
};

int play(HilArguments arguments) {
  PlaybackOptions& options = arguments.options;
  options.lead = seconds_given(arguments.lead_s);
  for (const std::string& away : arguments.away) {
    if (!read_away(away, options.faults)) {
      fmt::print(stderr, "sparsight hil: {}\n", away_usage(away));
      return 2;
    }
  }
  const auto report = play_into_devices(options);
  if (!report) {
    fmt::print(stderr, "sparsight hil: {}\n", report.error().message);
    return 1;
  }
  fmt::print("{}", arguments.json ? playback_json(*report) : playback_text(*report));
  return report->whole && report->refused() == 0 ? 0 : 1;
}

void add_devices(CLI::App& command, RigDeviceNames& names) {
  command.add_option("--camera", names.camera, "video node that the rig reads")
      ->type_name("DEVICE")
      ->capture_default_str();
  command
      .add_option("--camera-output", names.camera_output,
                  "video node to write frames to, where it is another one (vivid)")
      ->type_name("DEVICE");
  command.add_option("--chip", names.chip, "GPIO chip, one of the kernel's gpio-sim")
      ->type_name("DEVICE")
      ->capture_default_str();
  command.add_option("--lidar-to", names.lidar_address, "where LiDAR packets are sent")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command
      .add_option("--lidar-from", names.sensor_address,
                  "the address they come from, for the rig's file")
      ->type_name("ADDRESS")
      ->capture_default_str();
}

}  // namespace

void add_hil(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<HilArguments>();
  PlaybackOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand(
      "hil", "Play a recording into device interfaces (V4L2, GPIO, UDP), with its own timing");
  command->add_option("RECORDING", options.recording, "MCAP file, with a rig's raw data")
      ->required();
  add_devices(*command, options.devices);
  command
      ->add_option("--write-rig", options.write_rig,
                   "write a rig's file for these devices, for sparsight run --rig")
      ->type_name("FILE");
  command->add_option("--lead", arguments->lead_s, "seconds between that and the first event")
      ->check(CLI::Range(0.0, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--away", arguments->away,
                   "DEVICE:FROM:SECONDS: nothing comes from camera, lidar or trigger for a while")
      ->allow_extra_args(false);
  command
      ->add_option("--lose-edges", options.faults.lost_edges,
                   "share of exposures that do not show on their line")
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--json", arguments->json, "print the account as JSON");
  command->callback([arguments, &exit_code] { exit_code = play(*arguments); });
}

}  // namespace sparsight
