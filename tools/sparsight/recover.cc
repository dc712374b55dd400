#include "drivers/recording/recover.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "hal/time.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

struct RecoverArguments {
  std::filesystem::path damaged;
  std::filesystem::path output;
  bool json = false;
};

std::filesystem::path default_output(std::filesystem::path damaged) {
  return damaged.replace_extension(".recovered.mcap");
}

std::string recovery_json(const RecoverArguments& arguments, const RecoveryReport& report) {
  const nlohmann::ordered_json json{{"input", arguments.damaged.string()},
                                    {"output", arguments.output.string()},
                                    {"was_whole", report.was_whole},
                                    {"messages", report.messages},
                                    {"attachments", report.attachments},
                                    {"duration_s", to_seconds(report.duration)},
                                    {"bytes_read", report.bytes_read},
                                    {"bytes_written", report.bytes_written},
                                    {"damaged_chunks", report.faults.damaged_chunks},
                                    {"damaged_records", report.faults.damaged_records},
                                    {"lost_its_place", report.faults.lost_its_place}};
  return json.dump(2) + "\n";
}

std::string recovery_text(const RecoverArguments& arguments, const RecoveryReport& report) {
  std::string text =
      fmt::format("{}: {} messages of {:.1f} s, {} attachments, {:.1f} MB\n",
                  arguments.output.string(), report.messages, to_seconds(report.duration),
                  report.attachments, 1e-6 * static_cast<double>(report.bytes_written));
  if (report.was_whole) text += "The recording was closed properly; this is a copy.\n";
  if (report.faults.damaged_chunks + report.faults.damaged_records > 0) {
    text += fmt::format("{} chunks and {} other records were damaged and are left out.\n",
                        report.faults.damaged_chunks, report.faults.damaged_records);
  }
  return text;
}

int recover(RecoverArguments arguments) {
  if (arguments.output.empty()) arguments.output = default_output(arguments.damaged);
  const auto report = recover_recording(arguments.damaged, arguments.output);
  if (!report) {
    fmt::print(stderr, "sparsight recover: {}\n", report.error().message);
    return 1;
  }
  fmt::print(
      "{}", arguments.json ? recovery_json(arguments, *report) : recovery_text(arguments, *report));
  return 0;
}

}  // namespace

void add_recover(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<RecoverArguments>();
  CLI::App* command = app.add_subcommand(
      "recover", "Make a whole, indexed recording of one that was cut off or damaged");
  command->add_option("RECORDING", arguments->damaged, "MCAP file; it is left as it is")
      ->required();
  command->add_option("--output", arguments->output,
                      "File to write; it must not exist (default: RECORDING.recovered.mcap)");
  command->add_flag("--json", arguments->json, "Print JSON, for machines");
  command->callback([arguments, &exit_code] { exit_code = recover(*arguments); });
}

}  // namespace sparsight
