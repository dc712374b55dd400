#pragma once

#include <toml++/toml.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
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
      : table_(table), path_(std::move(path)), errors_(errors), errors_before_(errors.size()) {}

  // A number, a duration in the unit that its key names, or an array of numbers.
  template <typename Number>
  void field(std::string_view key, Number& value, FieldRange range) {
    if (const toml::node* node = find(key)) take(key, *node, value, range);
  }
  template <typename Number>
  void field(std::string_view key, std::optional<Number>& value, FieldRange range) {
    Number number{};
    const toml::node* node = find(key);
    if (node && take(key, *node, number, range)) value = number;
  }
  template <typename Number>
  void required_field(std::string_view key, Number& value, FieldRange range) {
    require(key);
    field(key, value, range);
  }
  void field(std::string_view key, bool& value);
  void text(std::string_view key, std::string& value, const TextRule& rule);

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
    allowed.reserve(names.size());
    for (const auto& name : names) allowed.push_back(name.first);
    refuse_choice(key, *node, allowed);
  }
  template <typename Enum>
  void choice(std::string_view key, std::optional<Enum>& value,
              const std::vector<std::pair<std::string_view, Enum>>& names) {
    if (!table_.contains(key)) return known_.push_back(key);
    Enum chosen{};
    const std::size_t errors = errors_.size();
    choice(key, chosen, names);
    if (errors_.size() == errors) value = chosen;
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
  // A table that is there or not; TomlWriter writes it if `present`.
  template <typename Struct>
  void optional_table(std::string_view key, Struct& value, bool /*present*/) {
    table(key, value);
  }

  // [[key]], any number of times.
  template <typename Struct>
  void list(std::string_view key, std::vector<Struct>& values) {
    const toml::node* node = find(key);
    if (!node) return;
    const toml::array* elements = node->as_array();
    if (!elements) return refuse(key, *node, "must be a list of tables, [[" + nested(key) + "]]");
    for (const toml::node& element : *elements) {
      if (!element.is_table()) {
        refuse(key, element, "must be a table, [[" + nested(key) + "]]");
        continue;
      }
      TomlReader reader(*element.as_table(), nested(key), errors_);
      visit_fields(reader, values.emplace_back());
      reader.refuse_unknown_keys();
    }
  }

  // A rotation and a translation; `meaning` is what it does: "p_a = T_a_b * p_b".
  void transform(std::string_view key, Eigen::Isometry3d& T, std::string_view meaning);

  void require(std::string_view key);
  // What must hold of several fields together, tried once each is right by itself; `key` is the
  // one that the error points at.
  void check(std::string_view key, bool holds, const std::string& fix);

  // After all fields were visited.
  void refuse_unknown_keys();

 private:
  // False, and an error, unless the node holds such a value.
  template <typename Number>
  bool take(std::string_view key, const toml::node& node, Number& value, FieldRange range) {
    if constexpr (std::is_integral_v<Number>) {
      if (!node.is_integer()) return refused(key, node, "must be a whole number");
    } else {
      if (!node.is_number()) return refused(key, node, "must be a number");
    }
    // Not value<double>() alone: it is empty for integers that a double cannot hold exactly.
    const double number = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                            : node.as_floating_point()->get();
    if (!(number >= range.min && number <= range.max)) return refused_range(key, node, range);
    if constexpr (std::is_integral_v<Number>) {
      value = static_cast<Number>(node.as_integer()->get());
    } else {
      value = number;
    }
    return true;
  }
  template <typename Count, typename Period>
  bool take(std::string_view key, const toml::node& node,
            std::chrono::duration<Count, Period>& value, FieldRange range) {
    Count count{};
    if (!take(key, node, count, range)) return false;
    value = std::chrono::duration<Count, Period>(count);
    return true;
  }
  template <typename Element, std::size_t kSize>
  bool take(std::string_view key, const toml::node& node, std::array<Element, kSize>& values,
            FieldRange range) {
    const toml::array* elements = node.as_array();
    if (!elements) return refused(key, node, size_text("must be a list of ", kSize));
    if (elements->size() != kSize) {
      return refused(key, node,
                     size_text("must have ", kSize) + size_text(", has ", elements->size()));
    }
    bool all = true;
    for (std::size_t i = 0; i < kSize; ++i) all &= take(key, (*elements)[i], values[i], range);
    return all;
  }

  const toml::node* find(std::string_view key);
  std::string nested(std::string_view key) const;
  std::string prefix() const;
  int line_of_table() const;
  static std::string size_text(std::string_view before, std::size_t size);
  void refuse(std::string_view key, const toml::node& node, const std::string& fix);
  bool refused(std::string_view key, const toml::node& node, const std::string& fix);
  bool refused_range(std::string_view key, const toml::node& node, FieldRange range);
  void refuse_choice(std::string_view key, const toml::node& node,
                     const std::vector<std::string_view>& allowed);

  const toml::table& table_;
  std::string path_;  // "" at the top, else "tracker" or "tracker.kernel"
  std::vector<FileError>& errors_;
  std::size_t errors_before_;  // of other tables
  std::vector<std::string_view> known_;
};

}  // namespace sparsight
