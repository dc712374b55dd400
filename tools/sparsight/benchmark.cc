#include "tools/benchmark/benchmark.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "tools/benchmark/benchmark_progress.h"
#include "tools/benchmark/benchmark_report.h"
#include "tools/benchmark/replay_process.h"
#include "tools/configuration/profile.h"
#include "tools/session/atomic_file.h"
#include "tools/session/interrupt.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";

struct BenchmarkArguments {
  std::filesystem::path kitti;
  std::vector<std::string> sequences;
  BenchmarkOptions options;
  bool quiet = false;
};

int fail_with(const Error& error, int exit_code) {
  fmt::print(stderr, "sparsight benchmark: {}\n", error.message);
  return exit_code;
}

// Absolute, as a finished run is known by where its data are; each ray count and sequence once.
void settle(BenchmarkArguments& arguments) {
  std::error_code error;
  arguments.kitti = std::filesystem::weakly_canonical(arguments.kitti, error);
  const auto make_unique = [](auto& values) {
    auto end = values.begin();
    for (const auto& value : values) {
      if (std::find(values.begin(), end, value) == end) *end++ = value;
    }
    values.erase(end, values.end());
  };
  make_unique(arguments.options.rays);
  make_unique(arguments.sequences);
  if (arguments.options.output.empty()) {
    arguments.options.output =
        "benchmark-" + std::filesystem::path(arguments.options.profile).stem().string();
  }
}

std::string command_of(const BenchmarkArguments& arguments) {
  const BenchmarkOptions& options = arguments.options;
  std::string command =
      fmt::format("sparsight benchmark {} --rays {} --profile {}", arguments.kitti.string(),
                  fmt::join(options.rays, ","), options.profile);
  if (!arguments.sequences.empty()) {
    command += fmt::format(" --sequences {}", fmt::join(arguments.sequences, ","));
  }
  if (options.max_frames) command += fmt::format(" --max-frames {}", *options.max_frames);
  return command;
}

Result<void> write_reports(const Benchmark& benchmark, const std::string& command) {
  const std::filesystem::path& folder = benchmark.options.output;
  return write_file(folder / "benchmark.json", benchmark_json(benchmark, command)).and_then([&] {
    return write_file(folder / "benchmark.md", benchmark_markdown(benchmark, command));
  });
}

Benchmark run_watched(const KittiSequences& sequences, const BenchmarkArguments& arguments) {
  BenchmarkProgress progress(stderr, Progress::style_for(stderr, arguments.quiet));
  const InterruptRequest interrupt;
  return run_benchmark(
      sequences, arguments.options, replay_in_process(kThisProgram),
      {.on_plan = [&](const auto& entries) { progress.plan(entries); },
       .on_begin = [&](std::size_t entry) { progress.begin(entry); },
       .on_progress = [&](std::size_t entry, std::size_t done) { progress.progress(entry, done); },
       .on_end = [&](std::size_t entry, const auto& result) { progress.end(entry, result); },
       .interrupted = [&] { return interrupt.pending(); }});
}

int benchmark(BenchmarkArguments arguments) {
  settle(arguments);
  const auto profile = load_profile(arguments.options.profile);
  if (!profile) return fail_with(profile.error(), 2);
  arguments.options.profile_text = describe_profile(*profile);
  const auto program = fingerprint(kThisProgram);
  if (!program) return fail_with(program.error(), 1);
  arguments.options.program = *program;
  const auto sequences = find_kitti_sequences(arguments.kitti, arguments.sequences);
  if (!sequences) return fail_with(sequences.error(), 1);

  const Benchmark result = run_watched(*sequences, arguments);
  const std::string command = command_of(arguments);
  fmt::print("{}", benchmark_markdown(result, command));
  if (auto written = write_reports(result, command); !written) return fail_with(written.error(), 1);
  fmt::print("\nReports: {}\n", (result.options.output / "benchmark.{md,json}").string());
  return result.all_done() ? 0 : 1;
}

}  // namespace

void add_benchmark(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<BenchmarkArguments>();
  BenchmarkOptions& options = arguments->options;
  CLI::App* command = app.add_subcommand(
      "benchmark",
      "Replay every sequence of a KITTI odometry folder; the paper's results beside ours");
  command
      ->add_option("KITTI_FOLDER", arguments->kitti,
                   "folder with sequences/NN (image_0, velodyne, calib.txt) and poses/NN.txt")
      ->required();
  command
      ->add_option("--output", options.output,
                   "folder of the sessions and the reports (default: ./benchmark-PROFILE); the "
                   "same command goes on with what is there")
      ->type_name("DIR");
  command->add_option("--rays", options.rays, "numbers of rings to keep of each scan")
      ->type_name("N,N...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--profile", options.profile, "paper, default, or a TOML file")
      ->type_name("NAME|FILE")
      ->capture_default_str();
  command
      ->add_option("--sequences", arguments->sequences, "only these (default: all that are there)")
      ->type_name("NN,NN...")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--max-frames", options.max_frames, "replay only the first N of each")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_option("--jobs", options.jobs, "replays at once; more than one falsifies times")
      ->type_name("N")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->add_flag("--quiet", arguments->quiet, "no progress");
  command->callback([arguments, &exit_code] { exit_code = benchmark(*arguments); });
}

}  // namespace sparsight
