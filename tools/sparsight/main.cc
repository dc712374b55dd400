#include <CLI/CLI.hpp>

#include "tools/sparsight/subcommands.h"

int main(int argc, char** argv) {
  CLI::App app{"Direct visual SLAM on sparse LiDAR depth"};
  app.require_subcommand(1);
  int exit_code = 0;
  sparsight::add_run(app, exit_code);
  sparsight::add_record(app, exit_code);
  sparsight::add_replay(app, exit_code);
  sparsight::add_evaluate(app, exit_code);
  sparsight::add_simulate(app, exit_code);
  sparsight::add_benchmark(app, exit_code);
  sparsight::add_hil(app, exit_code);
  sparsight::add_recover(app, exit_code);
  sparsight::add_doctor(app, exit_code);
  sparsight::add_optimise(app, exit_code);
  sparsight::add_train_vocabulary(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return exit_code;
}
