#include "tools/benchmark/aligned_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace sparsight {
namespace {

// Of text in UTF-8 whose characters are one column wide: every byte but those that continue one.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char byte) { return (byte & 0xC0) != 0x80; }));
}

}  // namespace

std::string aligned_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 3);  // Markdown's rule needs three
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      text += "| " + std::string(widths[i] - width(rows[r][i]), ' ') + rows[r][i] + " ";
    }
    text += "|\n";
    if (r > 0) continue;
    for (const std::size_t column : widths) text += "| " + std::string(column - 1, '-') + ": ";
    text += "|\n";
  }
  return text;
}

}  // namespace sparsight
