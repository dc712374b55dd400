#include "realtime/executor/interrupt_threads.h"

#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <system_error>

namespace sparsight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCommLength = 15;  // the kernel's TASK_COMM_LEN, without the closing zero
constexpr std::string_view kPrefix = "irq/";
constexpr std::string_view kSecondHalf = "s-";  // of a handler whose driver made it of two

std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string first_line_of(const fs::path& file) {
  std::string line;
  std::getline(std::ifstream(file), line);
  return line;
}

// Message-signalled ones, a folder with a file for each, or else the one of the wire; 0 is none.
std::vector<int> numbers_at(const fs::path& device) {
  std::vector<int> numbers;
  std::error_code error;
  for (fs::directory_iterator at(device / "msi_irqs", error), end; !error && at != end;
       at.increment(error)) {
    if (const auto number = number_of(at->path().filename().string())) numbers.push_back(*number);
  }
  if (!numbers.empty()) return numbers;
  const auto wire = number_of(first_line_of(device / "irq"));
  if (wire && *wire > 0) numbers.push_back(*wire);
  return numbers;
}

// As a whole, cut, or as one of several: "eth0-rx-1".
bool shows(std::string_view shown, bool cut, std::string_view name) {
  if (cut && name.starts_with(shown)) return true;
  return shown.starts_with(name) && (shown.size() == name.size() || shown[name.size()] == '-');
}

bool stands_as_high(pid_t thread, int fifo_priority) {
  sched_param parameters{};
  return sched_getscheduler(thread) == SCHED_FIFO && sched_getparam(thread, &parameters) == 0 &&
         parameters.sched_priority >= fifo_priority;
}

}  // namespace

Interrupts interrupts_behind(const fs::path& device) {
  Interrupts found;
  std::error_code error;
  fs::path at = fs::canonical(device, error);
  if (error) return found;
  for (; at.has_relative_path() && at.filename() != "devices"; at = at.parent_path()) {
    found.numbers = numbers_at(at);
    if (!found.numbers.empty()) return {.numbers = std::move(found.numbers)};
    found.names.push_back(at.filename());
  }
  return found;
}

bool serves_interrupt(std::string_view comm, const Interrupts& interrupts) {
  const std::size_t dash = comm.find('-');
  if (!comm.starts_with(kPrefix) || dash == std::string_view::npos) return false;
  const auto number = number_of(comm.substr(kPrefix.size(), dash - kPrefix.size()));
  std::string_view shown = comm.substr(dash + 1);
  if (shown.starts_with(kSecondHalf)) shown.remove_prefix(kSecondHalf.size());
  const bool cut = comm.size() == kCommLength;
  return (number && std::ranges::count(interrupts.numbers, *number) > 0) ||
         std::ranges::any_of(interrupts.names,
                             [&](const std::string& name) { return shows(shown, cut, name); });
}

std::optional<std::string> raise_interrupt_threads(const Interrupts& interrupts, int fifo_priority,
                                                   const fs::path& proc) {
  std::optional<std::string> problem;
  if (interrupts.numbers.empty() && interrupts.names.empty()) return problem;
  std::error_code error;
  for (fs::directory_iterator at(proc, error), end; !error && at != end; at.increment(error)) {
    const auto pid = number_of(at->path().filename().string());
    if (!pid) continue;
    const std::string comm = first_line_of(at->path() / "comm");
    if (!serves_interrupt(comm, interrupts) || stands_as_high(*pid, fifo_priority)) continue;
    const sched_param parameters{.sched_priority = fifo_priority};
    if (sched_setscheduler(*pid, SCHED_FIFO, &parameters) == 0) continue;
    problem = "the kernel's thread " + comm +
              " keeps its priority, so that what it delivers may be late or lost under load; give "
              "CAP_SYS_NICE: " +
              std::strerror(errno);
  }
  return problem;
}

}  // namespace sparsight
