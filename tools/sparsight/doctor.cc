#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "tools/configuration/rig_file.h"
#include "tools/doctor/doctor_report.h"
#include "tools/doctor/examination.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

struct DoctorArguments {
  std::string rig;
  std::string folder = ".";
  double seconds = 3.0;
  bool json = false;
};

int doctor(const DoctorArguments& arguments) {
  const auto rig = load_rig(arguments.rig);
  if (!rig) {
    std::fprintf(stderr, "sparsight doctor: %s\n", rig.error().message.c_str());
    return 1;
  }
  Examination examination;
  examination.folder = arguments.folder;
  examination.duration = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(arguments.seconds));
  RigDevices devices = live_devices(*rig);
  const std::vector<Check> checks = examine(devices, *rig, examination);
  std::fputs((arguments.json ? doctor_json(checks) : doctor_text(checks)).c_str(), stdout);
  return is_fit(checks) ? 0 : 1;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<DoctorArguments>();
  CLI::App* command = app.add_subcommand("doctor", "Say whether the rig is fit, and what to do");
  command->add_option("--rig", arguments->rig, "Rig file, such as config/rig/handheld.toml")
      ->required();
  command->add_option("--folder", arguments->folder, "Where recordings will go")
      ->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "How long the devices are watched")
      ->check(CLI::Range(0.5, 60.0))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON, for machines");
  command->callback([arguments, &exit_code] { exit_code = doctor(*arguments); });
}

}  // namespace sparsight
