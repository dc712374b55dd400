#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/configuration/rig_file.h"
#include "tools/doctor/doctor_report.h"
#include "tools/doctor/examination.h"
#include "tools/doctor/frame_examination.h"
#include "tools/doctor/host_checks.h"
#include "tools/doctor/recording_examination.h"
#include "tools/session/open_source.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

struct DoctorArguments {
  std::string source;
  std::string rig;
  std::string folder = ".";
  std::string overlay;
  double seconds = 3.0;
  bool json = false;
};

std::vector<Check> examine_live(const DoctorArguments& arguments, const RigConfig& rig,
                                const std::filesystem::path& overlay) {
  Examination examination;
  examination.folder = arguments.folder;
  examination.overlay = overlay;
  examination.duration = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(arguments.seconds));
  RigDevices devices = live_devices(rig);
  return examine(devices, rig, examination);
}

Result<std::vector<Check>> examine_source(const std::string& source,
                                          const std::optional<RigConfig>& rig,
                                          const std::filesystem::path& overlay) {
  if (is_recording(source)) return examine_recording(source, rig, overlay);
  auto opened = open_source(source, {});
  if (!opened) return tl::unexpected(opened.error());
  std::vector<Check> checks{calibration_check(opened->frames->calibration())};
  checks.push_back(examine_alignment(*opened->frames, overlay));
  return checks;
}

Result<std::vector<Check>> examination_of(const DoctorArguments& arguments) {
  const std::filesystem::path overlay =
      arguments.overlay.empty() ? std::filesystem::path(arguments.folder) / "doctor_overlay.png"
                                : std::filesystem::path(arguments.overlay);
  std::optional<RigConfig> rig;
  if (!arguments.rig.empty()) {
    auto loaded = load_rig(arguments.rig);
    if (!loaded) return tl::unexpected(loaded.error());
    rig = std::move(*loaded);
  }
  if (!arguments.source.empty()) return examine_source(arguments.source, rig, overlay);
  return examine_live(arguments, *rig, overlay);
}

int doctor(const DoctorArguments& arguments) {
  if (arguments.source.empty() && arguments.rig.empty()) {
    std::fputs(
        "sparsight doctor: give the rig's file (--rig config/rig/handheld.toml), or a "
        "recording\n",
        stderr);
    return 2;
  }
  const auto checks = examination_of(arguments);
  if (!checks) {
    std::fprintf(stderr, "sparsight doctor: %s\n", checks.error().message.c_str());
    return 1;
  }
  std::fputs((arguments.json ? doctor_json(*checks) : doctor_text(*checks)).c_str(), stdout);
  return is_fit(*checks) ? 0 : 1;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<DoctorArguments>();
  CLI::App* command = app.add_subcommand("doctor", "Say whether the rig is fit, and what to do");
  command->add_option("SOURCE", arguments->source,
                      "Recording (.mcap) to be looked at in place of the live rig; of any other "
                      "source of replay only how the LiDAR lies on the image");
  command->add_option(
      "--rig", arguments->rig,
      "Rig file, such as config/rig/handheld.toml; for a recording, in place of the "
      "description in it");
  command->add_option("--folder", arguments->folder, "Where recordings will go")
      ->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "How long the devices are watched")
      ->check(CLI::Range(0.5, 60.0))
      ->capture_default_str();
  command
      ->add_option("--overlay", arguments->overlay,
                   "Picture of the LiDAR on the image (default: doctor_overlay.png in the folder)")
      ->type_name("FILE");
  command->add_flag("--json", arguments->json, "Print JSON, for machines");
  command->callback([arguments, &exit_code] { exit_code = doctor(*arguments); });
}

}  // namespace sparsight
