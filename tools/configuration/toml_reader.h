#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tools/configuration/field_range.h"

namespace sparsight {

struct FileError {
  int line;
  std::string text;
};

// Visits the fields of one struct and takes their values from one TOML table. What the table holds
// beyond them is an error, as is every value of the wrong type or out of range.
class TomlReader {
 public:
  TomlReader(const toml::table& table, std::string path, std::vector<FileError>& errors)
      : table_(table), path_(std::move(path)), errors_(errors) {}

  template <typename Number>
  void field(std::string_view key, Number& value, FieldRange range) {
    const toml::node* node = find(key);
    if (!node) return;
    if constexpr (std::is_integral_v<Number>) {
      if (!node->is_integer()) return refuse(key, *node, "must be a whole number");
    } else {
      if (!node->is_number()) return refuse(key, *node, "must be a number");
    }
    // Not value<double>() alone: it is empty for integers that a double cannot hold exactly.
    const double number = node->is_integer() ? static_cast<double>(node->as_integer()->get())
                                             : node->as_floating_point()->get();
    if (!(number >= range.min && number <= range.max)) return refuse_range(key, *node, range);
    value = static_cast<Number>(number);
  }
  void field(std::string_view key, bool& value);

  template <typename Enum>
  void choice(std::string_view key, Enum& value,
              const std::vector<std::pair<std::string_view, Enum>>& names) {
    const toml::node* node = find(key);
    if (!node) return;
    const std::string text = node->value<std::string>().value_or("");
    const auto named = [&](const auto& name) { return name.first == text; };
    const auto match = std::find_if(names.begin(), names.end(), named);
    if (match != names.end()) {
      value = match->second;
      return;
    }
    std::vector<std::string_view> allowed;
    for (const auto& name : names) allowed.push_back(name.first);
    refuse_choice(key, *node, allowed);
  }

  template <typename Struct>
  void table(std::string_view key, Struct& value) {
    const toml::node* node = find(key);
    if (!node) return;
    if (!node->is_table()) return refuse(key, *node, "must be a table, [" + nested(key) + "]");
    TomlReader reader(*node->as_table(), nested(key), errors_);
    visit_fields(reader, value);
    reader.refuse_unknown_keys();
  }

  // After all fields were visited.
  void refuse_unknown_keys();

 private:
  const toml::node* find(std::string_view key);
  std::string nested(std::string_view key) const;
  void refuse(std::string_view key, const toml::node& node, const std::string& fix);
  void refuse_range(std::string_view key, const toml::node& node, FieldRange range);
  void refuse_choice(std::string_view key, const toml::node& node,
                     const std::vector<std::string_view>& allowed);

  const toml::table& table_;
  std::string path_;  // "" at the top, else "tracker" or "tracker.kernel"
  std::vector<FileError>& errors_;
  std::vector<std::string_view> known_;
};

}  // namespace sparsight
