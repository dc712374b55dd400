#include "realtime/executor/interrupt_threads.h"

#include <sched.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <system_error>

namespace sparsight {
namespace {

constexpr std::size_t kCommLength = 15;  // the kernel's TASK_COMM_LEN, without the closing zero

std::optional<pid_t> number_of(const std::string& name) {
  pid_t pid = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
  if (error != std::errc{} || end != name.data() + name.size()) return std::nullopt;
  return pid;
}

std::string comm_of(const std::filesystem::path& process) {
  std::string comm;
  std::getline(std::ifstream(process / "comm"), comm);
  return comm;
}

}  // namespace

bool serves_interrupt(std::string_view comm, std::string_view name) {
  const std::size_t dash = comm.find('-');
  if (!comm.starts_with("irq/") || dash == std::string_view::npos) return false;
  const std::string_view shown = comm.substr(dash + 1);
  return shown == name || (comm.size() == kCommLength && name.starts_with(shown));
}

std::optional<std::string> raise_interrupt_threads(std::string_view name, int fifo_priority,
                                                   const std::filesystem::path& proc) {
  std::optional<std::string> problem;
  std::error_code error;
  for (std::filesystem::directory_iterator at(proc, error), end; !error && at != end;
       at.increment(error)) {
    const auto pid = number_of(at->path().filename().string());
    if (!pid) continue;
    const std::string comm = comm_of(at->path());
    if (!serves_interrupt(comm, name)) continue;
    const sched_param parameters{.sched_priority = fifo_priority};
    if (sched_setscheduler(*pid, SCHED_FIFO, &parameters) == 0) continue;
    problem = "the kernel's thread " + comm +
              " keeps its priority, so that edges may be late or lost under load; give "
              "CAP_SYS_NICE: " +
              std::strerror(errno);
  }
  return problem;
}

}  // namespace sparsight
