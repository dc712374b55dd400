#include <CLI/CLI.hpp>

#include "tools/sparsight/subcommands.h"

namespace sparsight {

void add_replay(CLI::App& app, int& exit_code) {
  app.add_subcommand("replay", "")->callback([&exit_code] { exit_code = 1; });
}

}  // namespace sparsight
