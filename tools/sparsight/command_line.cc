#include "tools/sparsight/command_line.h"

#include <CLI/CLI.hpp>

#include "tools/sparsight/subcommands.h"

namespace sparsight {

int run_command_line(int argc, char** argv) {
  CLI::App app{"Direct visual SLAM on sparse LiDAR depth"};
  app.require_subcommand(1);
  int exit_code = 0;
  add_run(app, exit_code);
  add_record(app, exit_code);
  add_replay(app, exit_code);
  add_evaluate(app, exit_code);
  add_simulate(app, exit_code);
  add_benchmark(app, exit_code);
  add_hil(app, exit_code);
  add_recover(app, exit_code);
  add_doctor(app, exit_code);
  add_optimise(app, exit_code);
  add_train_vocabulary(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return exit_code;
}

}  // namespace sparsight
