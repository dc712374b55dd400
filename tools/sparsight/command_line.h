#pragma once

namespace sparsight {

// The program `sparsight`: reads its subcommand and options, and does it. What it returns is the
// exit code: 0 done, 1 what was asked for failed, 2 wrong usage.
int run_command_line(int argc, char** argv);

}  // namespace sparsight
