#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "tools/evaluation/evaluation_files.h"
#include "tools/evaluation/evaluation_report.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

struct EvaluateArguments {
  std::string estimate;
  std::string truth;
  std::string times;
  std::string format = "auto";
  std::vector<double> lengths_m = SegmentOptions{}.lengths_m;
  std::size_t step_frames = SegmentOptions{}.step_frames;
  std::size_t rpe_delta_frames = 1;
  std::size_t revisit_places = 0;
  double max_time_difference_s = 0.02;
  bool loops = false;
  bool json = false;
};

// CLI::Range lets "nan" through.
CLI::Validator positive_number() {
  return {[](const std::string& text) {
            double value = 0.0;
            const bool valid = CLI::detail::lexical_cast(text, value) && value > 0.0 && value < 1e9;
            return valid ? std::string() : text + " is not a length in metres above 0";
          },
          "> 0"};
}

EvaluationFiles files_of(const EvaluateArguments& arguments) {
  EvaluationFiles files{.estimate = arguments.estimate, .truth = arguments.truth};
  if (!arguments.times.empty()) {
    files.times = arguments.times;
  }
  if (arguments.format != "auto") {
    files.format = arguments.format == "kitti" ? TrajectoryFormat::kKitti : TrajectoryFormat::kTum;
  }
  return files;
}

EvaluationOptions options_of(const EvaluateArguments& arguments) {
  EvaluationOptions options{
      .segments = {.lengths_m = arguments.lengths_m, .step_frames = arguments.step_frames},
      .rpe_delta_frames = arguments.rpe_delta_frames,
      .revisits = {.places = arguments.revisit_places}};
  options.max_time_difference = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(arguments.max_time_difference_s));
  auto& lengths = options.segments.lengths_m;
  std::ranges::sort(lengths);
  lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
  return options;
}

Result<std::string> report_of(const EvaluateArguments& arguments) {
  const auto pair = read_trajectories(files_of(arguments));
  if (!pair) return tl::unexpected(pair.error());
  auto evaluation = evaluate_trajectories(pair->estimate, pair->truth, options_of(arguments));
  if (!evaluation) return tl::unexpected(evaluation.error());
  if (arguments.loops) {
    auto loops = evaluate_loops(arguments.estimate, pair->truth);
    if (!loops) return tl::unexpected(loops.error());
    evaluation->loops = *loops;
  }
  const EvaluatedFiles files{pair->estimate.source, pair->truth.source};
  return arguments.json ? evaluation_json(*evaluation, files)
                        : evaluation_table(*evaluation, files);
}

int evaluate(const EvaluateArguments& arguments) {
  const auto report = report_of(arguments);
  if (!report) {
    std::fprintf(stderr, "sparsight evaluate: %s\n", report.error().message.c_str());
    return 1;
  }
  std::fputs(report->c_str(), stdout);
  return 0;
}

}  // namespace

void add_evaluate(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<EvaluateArguments>();
  CLI::App* command =
      app.add_subcommand("evaluate", "Measure a trajectory's error against ground truth");
  command->add_option("ESTIMATE", arguments->estimate, "Trajectory file, or a session folder")
      ->required();
  command
      ->add_option("--ground-truth", arguments->truth,
                   "Trajectory file: KITTI (12 numbers a line) or TUM (t tx ty tz qx qy qz qw)")
      ->required();
  command->add_option("--times", arguments->times,
                      "KITTI times.txt; needed where one trajectory is KITTI and the other TUM");
  command->add_option("--format", arguments->format, "Format of ESTIMATE")
      ->check(CLI::IsMember({"auto", "kitti", "tum"}))
      ->capture_default_str();
  command
      ->add_option("--lengths", arguments->lengths_m,
                   "Segment lengths in metres; 10,20,30,40,50 for short drives")
      ->delimiter(',')
      ->allow_extra_args(false)  // or it would take ESTIMATE for a length
      ->check(positive_number())
      ->capture_default_str();
  command->add_option("--step", arguments->step_frames, "Frames between the starts of segments")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->capture_default_str();
  command->add_option("--rpe-delta", arguments->rpe_delta_frames, "Frames a motion of RPE spans")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}))
      ->capture_default_str();
  command
      ->add_option(
          "--revisits", arguments->revisit_places,
          "Of N places along the first lap: how far later passes come apart from the first")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}));
  command->add_flag("--loops", arguments->loops,
                    "ESTIMATE is a session folder: which of its loops are false, and which places "
                    "passed again it has not recognised");
  command
      ->add_option("--max-time-difference", arguments->max_time_difference_s,
                   "Seconds between poses that count as simultaneous")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON, for machines");
  command->callback([arguments, &exit_code] { exit_code = evaluate(*arguments); });
}

}  // namespace sparsight
