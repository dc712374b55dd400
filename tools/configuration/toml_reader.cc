#include "tools/configuration/toml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <sstream>

#include "tools/configuration/transform_fields.h"

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

// "" for what would fill the line: tables, long lists.
std::string text_of(const toml::node& node) {
  constexpr std::size_t kLongest = 80;
  std::string text;
  if (node.is_floating_point()) {
    text = fmt::format("{}", node.as_floating_point()->get());
  } else if (const toml::array* elements = node.as_array()) {
    std::vector<std::string> texts;
    for (const toml::node& element : *elements) texts.push_back(text_of(element));
    text = fmt::format("[{}]", fmt::join(texts, ", "));
  } else if (!node.is_table()) {
    std::ostringstream stream;
    node.visit([&](const auto& value) { stream << value; });
    text = stream.str();
  }
  return text.size() > kLongest ? "" : text;
}

// A table that only the tables in it have named stands on no line.
int line_of(const toml::node& node) {
  return std::max(1, static_cast<int>(node.source().begin.line));
}

}  // namespace

void TomlReader::field(std::string_view key, bool& value) {
  const toml::node* node = find(key);
  if (!node) return;
  if (!node->is_boolean()) return refuse(key, *node, "must be true or false");
  value = node->value<bool>().value();
}

void TomlReader::text(std::string_view key, std::string& value, const TextRule& rule) {
  const toml::node* node = find(key);
  if (!node) return;
  if (!node->is_string()) return refuse(key, *node, "must be a text in quotes");
  const std::string& text = node->as_string()->get();
  if (!rule.accepts(text)) return refuse(key, *node, rule.expected);
  value = text;
}

void TomlReader::transform(std::string_view key, Eigen::Isometry3d& T, std::string_view meaning) {
  const std::size_t errors = errors_.size();
  TransformFields fields;
  fields.meaning = meaning;
  table(key, fields);
  if (table_.contains(key) && errors_.size() == errors) T = isometry_of(fields);
}

void TomlReader::require(std::string_view key) {
  if (table_.contains(key)) return;
  errors_.push_back({line_of_table(), fmt::format("{}{}: missing", prefix(), key)});
}

void TomlReader::check(std::string_view key, bool holds, const std::string& fix) {
  if (holds || errors_.size() > errors_before_) return;
  if (const toml::node* node = table_.get(key)) return refuse(key, *node, fix);
  errors_.push_back({line_of_table(), fmt::format("{}{}: {}", prefix(), key, fix)});
}

const toml::node* TomlReader::find(std::string_view key) {
  known_.push_back(key);
  return table_.get(key);
}

std::string TomlReader::nested(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

std::string TomlReader::prefix() const { return path_.empty() ? "" : fmt::format("[{}] ", path_); }

int TomlReader::line_of_table() const { return line_of(table_); }

std::string TomlReader::size_text(std::string_view before, std::size_t size) {
  return fmt::format("{}{}", before, size);
}

void TomlReader::refuse(std::string_view key, const toml::node& node, const std::string& fix) {
  const std::string value = text_of(node);
  errors_.push_back({line_of(node), fmt::format("{}{}{}{}: {}", prefix(), key,
                                                value.empty() ? "" : " = ", value, fix)});
}

bool TomlReader::refused(std::string_view key, const toml::node& node, const std::string& fix) {
  refuse(key, node, fix);
  return false;
}

bool TomlReader::refused_range(std::string_view key, const toml::node& node, FieldRange range) {
  return refused(key, node, fmt::format("must be between {} and {}", range.min, range.max));
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
      errors_.push_back(
          {line, fmt::format("{}{}: unknown key; the nearest is {}", prefix(), key.str(), other)});
    }
  }
}

}  // namespace sparsight
