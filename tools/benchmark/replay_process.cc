#include "tools/benchmark/replay_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "tools/evaluation/text_file.h"

namespace sparsight {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPollInterval{100};
std::vector<std::string> arguments_of(const ReplayRun& run) {
  std::vector<std::string> arguments = {"sparsight",
                                        "replay",
                                        run.sequence.folder.string(),
                                        "--rays",
                                        std::to_string(run.rays),
                                        "--no-loops",  // as the figures published
                                        "--profile",
                                        run.profile,
                                        "--output",
                                        run.session.string(),
                                        "--quiet"};
  if (run.max_frames) {
    arguments.insert(arguments.end(), {"--max-frames", std::to_string(*run.max_frames)});
  }
  return arguments;
}

Result<pid_t> spawn(const std::filesystem::path& program, std::vector<std::string> arguments,
                    const std::filesystem::path& log) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                   0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error == 0) return child;
  return fail(ErrorCode::kUnreadable,
              fmt::format("{}: cannot be started with its log {}: {}", program.string(),
                          log.string(), std::strerror(error)));
}

// The journal has a head and a line per frame; it bears this name until the session is written.
std::size_t frames_done(const ReplayRun& run) {
  std::ifstream journal(run.session / "frames.csv.partial", std::ios::binary);
  const auto lines =
      std::count(std::istreambuf_iterator<char>(journal), std::istreambuf_iterator<char>(), '\n');
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(lines - 1, 0));
}

int wait_for(pid_t child, const ReplayRun& run, const ReplayWatch& watch,
             std::chrono::milliseconds own_end) {
  int status = 0;
  std::optional<Clock::time_point> interrupted_at;
  bool passed_on = false;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (!interrupted_at && watch.interrupted()) interrupted_at = Clock::now();
    if (interrupted_at && !passed_on && Clock::now() - *interrupted_at > own_end) {
      kill(child, SIGTERM);
      passed_on = true;
    }
    watch.on_progress(frames_done(run));
    std::this_thread::sleep_for(kPollInterval);
  }
  return status;
}

std::string last_line(const std::filesystem::path& log) {
  std::string text = read_text_file(log).value_or("");
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

std::string reason(int status, const ReplayRun& run) {
  const std::string end = WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                                              : fmt::format("exit code {}", WEXITSTATUS(status));
  return fmt::format("{}: {} (see {})", end, last_line(run.log()), run.log().string());
}

ReplayOutcome run_child(const std::filesystem::path& program, const ReplayRun& run,
                        const ReplayWatch& watch, std::chrono::milliseconds own_end) {
  const auto child = spawn(program, arguments_of(run), run.log());
  if (!child) return {ReplayOutcome::Status::kFailed, child.error().message};
  const int status = wait_for(*child, run, watch, own_end);
  if (watch.interrupted()) return {ReplayOutcome::Status::kInterrupted, ""};
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return {ReplayOutcome::Status::kFailed, reason(status, run)};
}

}  // namespace

ReplayRunner replay_in_process(const std::filesystem::path& program,
                               std::chrono::milliseconds own_end) {
  return [program, own_end](const ReplayRun& run, const ReplayWatch& watch) {
    return run_child(program, run, watch, own_end);
  };
}

Result<std::string> fingerprint(const std::filesystem::path& program) {
  return read_text_file(program).map([](const std::string& bytes) {
    std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a, 64 bits
    for (const char byte : bytes) {
      hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
    }
    return fmt::format("{:016x}", hash);
  });
}

}  // namespace sparsight
