#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

#include "tools/graph/optimise_graph.h"
#include "tools/sparsight/subcommands.h"

namespace sparsight {
namespace {

struct OptimiseArguments {
  OptimiseOptions options;
  bool plain = false;
  bool json = false;
};

int optimise(OptimiseArguments arguments) {
  if (arguments.plain) arguments.options.optimizer.dcs_phi = 0.0;
  const auto report = optimise_graph(arguments.options);
  if (!report) {
    std::fprintf(stderr, "sparsight optimise: %s\n", report.error().message.c_str());
    return 1;
  }
  std::fputs((arguments.json ? optimise_json(*report) : optimise_text(*report)).c_str(), stdout);
  return 0;
}

}  // namespace

void add_optimise(CLI::App& app, int& exit_code) {
  auto arguments = std::make_shared<OptimiseArguments>();
  CLI::App* command = app.add_subcommand(
      "optimise", "Optimise a pose graph in g2o format (VERTEX_SE3:QUAT, EDGE_SE3:QUAT)");
  command->add_option("GRAPH", arguments->options.input, "g2o file")->required();
  command->add_option("--output", arguments->options.output, "g2o file to write")
      ->type_name("FILE");
  command->add_flag("--plain", arguments->plain,
                    "Least squares over all edges; without it, loops that the rest contradicts are "
                    "taken out");
  command
      ->add_option("--max-iterations", arguments->options.optimizer.max_iterations,
                   "Iterations of each descent")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "Print JSON, for machines");
  command->callback([arguments, &exit_code] { exit_code = optimise(*arguments); });
}

}  // namespace sparsight
