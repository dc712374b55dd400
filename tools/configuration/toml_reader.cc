#include "tools/configuration/toml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <sstream>

namespace sparsight {
namespace {

// Levenshtein's distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string_view nearest(std::string_view key, const std::vector<std::string_view>& known) {
  return *std::min_element(known.begin(), known.end(), [&](auto a, auto b) {
    return edit_distance(key, a) < edit_distance(key, b);
  });
}

std::string text_of(const toml::node& node) {
  if (node.is_floating_point()) return fmt::format("{}", node.as_floating_point()->get());
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

}  // namespace

void TomlReader::field(std::string_view key, bool& value) {
  const toml::node* node = find(key);
  if (!node) return;
  if (!node->is_boolean()) return refuse(key, *node, "must be true or false");
  value = node->value<bool>().value();
}

const toml::node* TomlReader::find(std::string_view key) {
  known_.push_back(key);
  return table_.get(key);
}

std::string TomlReader::nested(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TomlReader::refuse(std::string_view key, const toml::node& node, const std::string& fix) {
  const std::string table = path_.empty() ? "" : fmt::format("[{}] ", path_);
  errors_.push_back({line_of(node), fmt::format("{}{} = {}: {}", table, key, text_of(node), fix)});
}

void TomlReader::refuse_range(std::string_view key, const toml::node& node, FieldRange range) {
  refuse(key, node, fmt::format("must be between {} and {}", range.min, range.max));
}

void TomlReader::refuse_choice(std::string_view key, const toml::node& node,
                               const std::vector<std::string_view>& allowed) {
  refuse(key, node, fmt::format("must be one of \"{}\"", fmt::join(allowed, "\", \"")));
}

void TomlReader::refuse_unknown_keys() {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    const int line = static_cast<int>(key.source().begin.line);
    const std::string_view other = nearest(key.str(), known_);
    if (node.is_table()) {
      errors_.push_back({line, fmt::format("[{}]: unknown table; the nearest is [{}]",
                                           nested(key.str()), nested(other))});
    } else {
      const std::string table = path_.empty() ? "" : fmt::format("[{}] ", path_);
      errors_.push_back(
          {line, fmt::format("{}{}: unknown key; the nearest is {}", table, key.str(), other)});
    }
  }
}

}  // namespace sparsight
