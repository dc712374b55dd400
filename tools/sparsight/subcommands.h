#pragma once

namespace CLI {
class App;
}

namespace sparsight {

// Each adds its subcommand; when it is called it runs and stores 0 (done), 1 (failed) or 2 (usage).
void add_run(CLI::App& app, int& exit_code);
void add_record(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_evaluate(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_benchmark(CLI::App& app, int& exit_code);
void add_hil(CLI::App& app, int& exit_code);
void add_recover(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_optimise(CLI::App& app, int& exit_code);
void add_train_vocabulary(CLI::App& app, int& exit_code);

}  // namespace sparsight
