#include "tools/doctor/doctor_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

namespace sparsight {
namespace {

constexpr std::size_t kWidth = 100;

std::string_view word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kWarn:
      return "warn";
    default:
      return "fail";
  }
}

// The words of `text` in lines that each begin at column `indent`.
std::string wrapped(std::string_view text, std::size_t indent) {
  std::string lines;
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (column > indent && column + 1 + word.size() > kWidth) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

}  // namespace

bool is_fit(const std::vector<Check>& checks) {
  return std::none_of(checks.begin(), checks.end(),
                      [](const Check& check) { return check.verdict == Verdict::kFail; });
}

std::string doctor_text(const std::vector<Check>& checks) {
  std::size_t widest = 0;
  for (const Check& check : checks) widest = std::max(widest, check.name.size());
  const std::size_t indent = 6 + widest + 2;
  std::string text;
  for (const Check& check : checks) {
    text += fmt::format("{:<4}  {:<{}}  {}\n", word_of(check.verdict), check.name, widest,
                        wrapped(check.found, indent));
    if (check.fix.empty()) continue;
    text += fmt::format("{:>{}}{}\n", "-> ", indent + 3, wrapped(check.fix, indent + 3));
  }
  const auto count = [&](Verdict verdict) {
    return std::count_if(checks.begin(), checks.end(),
                         [&](const Check& check) { return check.verdict == verdict; });
  };
  const auto failed = count(Verdict::kFail);
  const auto warned = count(Verdict::kWarn);
  text +=
      failed > 0
          ? fmt::format("\nThe rig is not fit: {} of {} checks failed.\n", failed, checks.size())
      : warned > 0
          ? fmt::format("\nThe rig is fit, with {} warning{}.\n", warned, warned == 1 ? "" : "s")
          : std::string("\nThe rig is fit.\n");
  return text;
}

std::string doctor_json(const std::vector<Check>& checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Check& check : checks) {
    nlohmann::ordered_json entry{{"name", check.name},
                                 {"verdict", word_of(check.verdict)},
                                 {"found", check.found},
                                 {"fix", check.fix}};
    for (const auto& [name, value] : check.figures) entry["figures"][name] = value;
    list.push_back(std::move(entry));
  }
  const nlohmann::ordered_json report{{"fit", is_fit(checks)}, {"checks", list}};
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace sparsight
